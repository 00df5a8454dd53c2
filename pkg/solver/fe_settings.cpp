// The settings of FESolver: their limits, and their way into the world.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "solver/column_archive.hpp"
#include "solver/fe_solver.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

void FESettings::check() const {
  const auto refuse = [](const char* name, const std::string& value, const char* right) {
    throw std::invalid_argument(
        fmt::format("FESolver.{} is {}, it must be {}.", name, value, right));
  };
  const auto refuseNumber = [&](const char* name, double value, const char* right) {
    refuse(name, fmt::format("{:g}", value), right);
  };
  if (view != "component" && view != "fragment" && view != "mises")
    refuse("view", shownText(view), "'component', 'fragment' or 'mises'");
  if (passes != 1 && passes != 2) refuseNumber("passes", passes, "1 or 2");
  if (!(contactTolerance.value >= tolerance::kLeastStop &&
        contactTolerance.value <= tolerance::kMostStop))
    refuseNumber("contactTolerance", contactTolerance.value,
                 "from 1e-9 to 0.1, or 'fine', 'default' or 'coarse'");
  if (!(halo >= 0 && halo <= tolerance::kWidestHalo))
    refuseNumber("halo", halo,
                 "positive and at most 0.5, or 0 for a width that depends on the speed");
  if (!(damping >= 0 && std::isfinite(damping))) refuseNumber("damping", damping, "0 or positive");
  if (maxCracks < -1) refuseNumber("maxCracks", maxCracks, "0 or positive, or -1 for no limit");
  if (!(minFragmentArea >= 0 && std::isfinite(minFragmentArea)))
    refuseNumber("minFragmentArea", minFragmentArea, "positive (m²), or 0 to keep all fragments");
  if (!gravity.allFinite() || gravity[2] != 0)
    refuse("gravity", fmt::format("({:g}, {:g}, {:g})", gravity[0], gravity[1], gravity[2]),
           "finite, and z must be 0: bodies move in the plane z = 0 only");
  if (axisymmetric && gravity[0] != 0)
    refuse("gravity", fmt::format("({:g}, {:g}, {:g})", gravity[0], gravity[1], gravity[2]),
           "along the axis, y, since the scene is axisymmetric");
  const auto isViscosity = [](double v) { return v >= 0 && v <= tolerance::kMostViscosity; };
  const char* viscosity = "0 or positive, and at most 1e6";
  if (!isViscosity(linearViscosity)) refuseNumber("linearViscosity", linearViscosity, viscosity);
  if (!isViscosity(quadraticViscosity))
    refuseNumber("quadraticViscosity", quadraticViscosity, viscosity);
}

void FESolver::postLoad(FESolver& /*self*/) {
  try {
    settings.check();
    world_.setAxisymmetric(settings.axisymmetric);
  } catch (const std::exception& error) {
    settings = former_;
    throw std::invalid_argument(error.what());
  }
  giveSettings();
}

void FESolver::giveSettings() {
  former_ = settings;
  world_.contactSettings.passes = settings.passes;
  world_.contactSettings.halo = settings.halo;
  world_.contactSettings.constants.stop = settings.contactTolerance.value;
  world_.dynamicsSettings.damping = settings.damping;
  world_.dynamicsSettings.gravity = inPlane(settings.gravity);
  world_.dynamicsSettings.viscosity = {settings.linearViscosity, settings.quadraticViscosity};
  world_.fracture.maxCracks =
      settings.maxCracks < 0 ? ~std::uint64_t{0} : static_cast<std::uint64_t>(settings.maxCracks);
  world_.fracture.minFragmentArea = settings.minFragmentArea;
  world_.threads = threadsOf(*this);
}

namespace {

template <class Value>
Attribute setting(const char* name, Value FESettings::*member, const char* doc) {
  return attribute(name, &FESolver::settings, member, doc, yade::Attr::triggerPostLoad);
}

}  // namespace

Attributes FESolver::attributes() {
  using C = FESettings;
  return attributeList(
      setting("passes", &C::passes,
              "1: of two surfaces the points of the finer one and the sharp corners of the other "
              "must not "
              "penetrate; 2: the points of both. Where a body can crack, it is 2 in any case."),
      setting("contactTolerance", &C::contactTolerance,
              "Sweeps over the contacts of a step end when none changes a gap or a slip by more "
              "than this part of the largest displacement: from 1e-9 to 0.1, or 'fine' (1e-4), "
              "'default' (0.003) or 'coarse' (0.01). It trades time for overlaps and energy."),
      setting("halo", &C::halo,
              "Width of the strip around a boundary in which contact is expected, relative to the "
              "shortest segment, at most 0.5; 0: as wide as the bodies' speed requires. Results "
              "do not depend on it, but the number of searches does."),
      setting("damping", &C::damping, "Mass-proportional damping (1/s)."),
      setting("gravity", &C::gravity,
              "Acceleration of all bodies of this engine (m/s²), a pair, or three numbers with "
              "z = 0. Until it is set, it follows that of a NewtonIntegrator in O.engines."),
      attribute(
          "takesGravity", &FESolver::takesGravity,
          "`gravity` has x and y of NewtonIntegrator's gravity in each step. Setting `gravity` "
          "sets this to False, unless `engines` does; setting this to True undoes that."),
      setting("linearViscosity", &C::linearViscosity,
              "Coefficient of the linear bulk viscosity; 0: none, .06 is usual."),
      setting("quadraticViscosity", &C::quadraticViscosity,
              "Coefficient of the quadratic bulk viscosity, in compression; 0: none, 1.2 is "
              "usual."),
      setting("maxCracks", &C::maxCracks,
              "Maximum total number of edges that crack; -1: no limit."),
      setting("minFragmentArea", &C::minFragmentArea,
              "Detached fragments with a smaller area (m², stress-free) are removed from "
              "the scene, and counted in `dropped`, except held ones. 0: none is removed."),
      attribute("rigidBodies", &FESolver::rigidBodies,
                "Contact with YADE's Wall, Box and Facet, also in clumps: their sections "
                "with the plane z = 0, rigid, with the friction of their FrictMat. They move as "
                "YADE moves them, and get the forces of contact (O.forces.f, O.forces.t)."),
      setting("axisymmetric", &C::axisymmetric,
              "Bodies around an axis: x is the distance from it, y the place along it; masses, "
              "forces and energies are those of a full turn. Changes only without bodies."),
      setting("view", &C::view,
              "Meaning of the bodies' colours in YADE's 3D view: 'component', 'fragment', or "
              "'mises', from blue at 0 to red at the largest."));
}

void FESolver::archiveMore(AnyArchive& archive) {
  std::vector<yade::Body::id_t> ids = bodies_.ids();
  std::vector<Vec2> forces(contactForces().begin(), contactForces().end());
  archiveWorld(archive, world_, ids, forces);
  if (archive.isLoading()) loadedForces_ = std::move(forces);
  rigid_.archive(archive, world_);
  rolling_.archive(archive);
  crackContacts_.archive(archive);
  balance_.archive(archive);
  if (archive.isLoading()) bodies_.restore(std::move(ids));
}

}  // namespace yadefrag
