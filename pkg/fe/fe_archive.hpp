#pragma once
// Saves and loads the complete state of a world in YADE's archives, as columns of plain numbers.
// The run continues with the same bits from binary files and from XML, which contains all digits of
// a number. Damaged data are refused: a checksum covers all values, and every index is checked
// before use.

#include <boost/archive/archive_exception.hpp>
#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/nvp.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/checksum.hpp"
#include "core/errors.hpp"
#include "step/state_check.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// With the checksum a fuzzer would never reach the code behind it.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr bool kIgnoreChecksum = true;
#else
inline constexpr bool kIgnoreChecksum = false;
#endif

/// The numbers of which a value consists.
template <class T>
struct ScalarOf {
  using Type = T;
};
template <>
struct ScalarOf<Vec2> {
  using Type = double;
};
template <>
struct ScalarOf<Piece> {
  using Type = std::uint8_t;
};
template <class Tag>
struct ScalarOf<Id<Tag>> {
  using Type = std::uint32_t;
};
template <class T, std::size_t kCount>
struct ScalarOf<std::array<T, kCount>> : ScalarOf<T> {};

template <class Archive>
class WorldArchive {
 public:
  explicit WorldArchive(Archive& archive) : archive_(archive) {}

  /// `entryBodies`: YADE's body id of each entry. Throws InputError for data that are damaged or of
  /// another version, RunError if they cannot be written.
  void run(World& world, std::vector<int>& entryBodies) {
    try {
      all(world, entryBodies);
    } catch (const boost::archive::archive_exception& error) {
      if constexpr (Archive::is_saving::value)
        throw RunError(
            "FESolver could not be saved (" + std::string(error.what()) +
            "): its file cannot be opened or the disk is full, and the file is incomplete.");
      else
        refuse(error.what());
    }
  }

 private:
  static constexpr std::uint64_t kFormat = 16;
  /// (count) A damaged length must not exhaust the memory: values are read in parts of this size,
  /// and the archive ends before the memory is full.
  static constexpr std::uint64_t kPart = 1 << 16;

  [[noreturn]] static void refuse(const std::string& what) {
    throw InputError("The saved state of FESolver is damaged or from another version (" + what +
                     "); load another save.");
  }

  void all(World& world, std::vector<int>& entryBodies) {
    std::uint64_t format = kFormat;
    value("format", format);
    if (format != kFormat) refuse("its format is " + std::to_string(format));
    state(world);
    value("entryBodies", entryBodies);
    std::uint64_t checksum = sum_.value();
    archive_& boost::serialization::make_nvp("checksum", checksum);
    if constexpr (Archive::is_loading::value) {
      if (checksum != sum_.value() && !kIgnoreChecksum) refuse("its checksum is wrong");
      const std::string wrong = findInvalidPart(world);
      if (!wrong.empty()) refuse(wrong + " are invalid");
      if (entryBodies.size() != world.surfaces.entries()) refuse("its bodies are invalid");
      world.rebuild();
    }
  }

  void state(World& world) {
    const auto isLate = [](std::string_view name) { return name == "reference"; };
    table(world.model.nodes.columns(), std::not_fn(isLate));
    motions(world.model.motions);
    table(world.model.triangles.columns());
    components(world.model.components);
    materials(world.model.materials);
    surfaces(world.surfaces);
    loads(world);
    contact(world.contact);
    search(world);
    fracture(world.fracture);
    EnergyLedger& ledger = world.ledger;
    value("contactEnergy", ledger.contact), value("frictionEnergy", ledger.friction);
    value("fractureWork", ledger.fracture), value("dampingEnergy", ledger.damping);
    value("externalEnergy", ledger.external), value("droppedEnergy", ledger.dropped);
    value("createdSpin", ledger.spin);
    Dropped& dropped = world.dropped;
    value("droppedMass", dropped.mass), value("dropped", dropped.count);
    value("droppedMomentumX", dropped.momentum.x), value("droppedMomentumY", dropped.momentum.y);
    watch(world);
    table(world.model.nodes.columns(), isLate);
    value("steps", world.steps), value("time", world.time), value("lastDt", world.lastDt);
    value("stableStep", world.stableStep);
    value("stableLinearViscosity", world.stableViscosity.linear);
    value("stableQuadraticViscosity", world.stableViscosity.quadratic);
    value("numSearches", world.search.count);
  }

  void watch(World& world) {
    EnergyWatch& watch = world.watch;
    value("expectedEnergy", watch.expected), value("goneEnergy", watch.gone);
    value("mostEnergy", watch.most);
    value("watchedContact", watch.dissipated);
    value("watchedSplit", watch.split);
    value("lookedCreated", watch.evaluatedCreated), value("lookedGrown", watch.evaluatedGrown);
    value("toldCreated", watch.reportedCreated), value("toldGrown", watch.reportedGrown);
    value("toldDepth", watch.reportedDepth), value("lastStep", watch.lastStep);
    value("leastStep", watch.leastStep), value("mostStep", watch.mostStep);
    value("stepChanges", watch.changes);
    value("mostSpin", watch.mostSpin), value("toldSpin", watch.reportedSpin);
    value("knownGrowth", watch.knownGrowth), value("ofChanges", watch.ofChanges);
    lines("complaints", world.warnings);
  }

  void lines(const char* name, std::vector<std::string>& all) {
    std::vector<char> text;
    for (const std::string& line : all) {
      text.insert(text.end(), line.begin(), line.end());
      text.push_back('\n');
    }
    value(name, text);
    if constexpr (Archive::is_loading::value) {
      all.clear();
      std::istringstream lines(std::string(text.begin(), text.end()));
      for (std::string line; std::getline(lines, line);) all.push_back(line);
    }
  }

  template <class Value>
  void value(const char* name, Value& value) {
    static_assert(std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>);
    archive_& boost::serialization::make_nvp(name, value);
    sum_.add(&value, sizeof value);
  }
  /// In a damaged file a bool could have any value.
  void value(const char* name, bool& value) {
    std::uint8_t flag = value ? 1 : 0;
    this->value(name, flag);
    value = flag != 0;
  }
  template <class Scalar>
  void value(const char* name, std::vector<Scalar>& values) {
    std::uint64_t count = values.size();
    value("count", count);
    if constexpr (Archive::is_loading::value) values.clear();
    for (std::uint64_t begin = 0; begin < count; begin += kPart) {
      const std::uint64_t size = std::min(kPart, count - begin);
      if constexpr (Archive::is_loading::value) values.resize(begin + size);
      const auto part = boost::serialization::make_array(values.data() + begin, size);
      archive_& boost::serialization::make_nvp(name, part);
    }
    if (count > 0) sum_.add(values.data(), count * sizeof(Scalar));
  }

  /// A column of structures that consist of `Scalar` only.
  template <class Scalar, class Element>
  void column(const char* name, std::vector<Element>& column) {
    // NOLINTNEXTLINE(bugprone-sizeof-expression): also correct for a column of plain numbers
    constexpr std::size_t each = sizeof(Element) / sizeof(Scalar);
    static_assert(std::is_trivially_copyable_v<Element> &&
                  sizeof(Element) == each * sizeof(Scalar));
    std::vector<Scalar> flat(column.size() * each);
    if (!column.empty()) std::memcpy(flat.data(), column.data(), flat.size() * sizeof(Scalar));
    value(name, flat);
    if (flat.size() % each != 0) refuse(std::string(name) + " has a wrong length");
    column.resize(flat.size() / each);
    if (!column.empty())
      std::memcpy(static_cast<void*>(column.data()), flat.data(), flat.size() * sizeof(Scalar));
  }

  /// One member of structures with several types of members.
  template <class Element, class Read>
  void member(const char* name, std::vector<Element>& rows, Read read) {
    using Value = std::remove_cvref_t<decltype(read(rows.front()))>;
    std::vector<Value> flat(rows.size());
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = read(rows[i]);
    value(name, flat);
    // The first member determines the number of rows.
    if (rows.empty()) rows.resize(flat.size());
    if (rows.size() != flat.size()) refuse(std::string(name) + " has a wrong length");
    for (std::size_t i = 0; i < flat.size(); ++i) read(rows[i]) = flat[i];
  }

  /// The columns of a table (core/columns.hpp) whose names are `wanted`.
  template <class Columns, class Wanted>
  void table(const Columns& columns, Wanted wanted) {
    columns([&]<class Element>(const Column& of, std::vector<Element>& array) {
      if (wanted(std::string_view(of.name)))
        column<typename ScalarOf<Element>::Type>(of.name, array);
    });
  }
  template <class Columns>
  void table(const Columns& columns) {
    table(columns, [](std::string_view) { return true; });
  }

  void motions(std::vector<Motion>& motions) {
    FlatMotions flat = flatten(motions);
    value("motionCounts", flat.counts), value("motionNumbers", flat.numbers);
    if constexpr (Archive::is_loading::value)
      if (!unflatten(flat, motions)) refuse("its motions are invalid");
  }

  void components(std::vector<Component>& rows) {
    using C = Component;
    materials(rows);
    member("thickness", rows, [](C& c) -> double& { return c.thickness; });
    member("firstTriangle", rows, [](C& c) -> std::uint32_t& { return c.firstTriangle; });
    member("lastTriangle", rows, [](C& c) -> std::uint32_t& { return c.lastTriangle; });
    member("firstMaterial", rows, [](C& c) -> std::uint32_t& { return c.firstMaterial; });
    member("lastMaterial", rows, [](C& c) -> std::uint32_t& { return c.lastMaterial; });
    flags("brittleByPlace", rows, [](C& c) -> bool& { return c.brittleByPlace; });
    flags("selfContact", rows, [](C& c) -> bool& { return c.selfContact; });
    flags("rigid", rows, [](C& c) -> bool& { return c.rigid; });
    member("element", rows, [](C& c) -> std::uint8_t& {
      return reinterpret_cast<std::uint8_t&>(c.element);  // NOLINT: an unsigned char may name it
    });
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const C& c : rows) names.push_back(c.name);
    lines("names", names);
    if (names.size() != rows.size()) refuse("names has a wrong length");
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].name = names[i];
  }

  /// Of bodies, or of a list.
  template <class C>
  void materials(std::vector<C>& rows) {
    member("young", rows, [](C& c) -> double& { return c.material.young; });
    member("poisson", rows, [](C& c) -> double& { return c.material.poisson; });
    member("density", rows, [](C& c) -> double& { return c.material.density; });
    member("friction", rows, [](C& c) -> double& { return c.friction; });
    member("tensileStrength", rows, [](C& c) -> double& { return c.brittle.tensileStrength; });
    member("fractureEnergy", rows, [](C& c) -> double& { return c.brittle.fractureEnergy; });
    member("shearFactor", rows, [](C& c) -> double& { return c.brittle.shearFactor; });
    member("shearEnergyFactor", rows, [](C& c) -> double& { return c.brittle.shearEnergyFactor; });
    member("weibullModulus", rows, [](C& c) -> double& { return c.brittle.weibullModulus; });
    member("strengthScatter", rows, [](C& c) -> double& { return c.brittle.strengthScatter; });
    member("seed", rows, [](C& c) -> std::uint64_t& { return c.brittle.seed; });
    member("referenceVolume", rows, [](C& c) -> double& { return c.brittle.referenceVolume; });
    curves("softeningCounts", "softeningPoints", rows,
           [](C& c) -> SofteningCurve& { return c.brittle.softening; });
    curves("rateCounts", "ratePoints", rows, [](C& c) -> RateEffect& { return c.brittle.rate; });
    member("rateEnergyPower", rows, [](C& c) -> double& { return c.brittle.rateEnergyPower; });
    flags("planeStress", rows, [](C& c) -> bool& { return c.material.planeStress; });
  }

  /// Of existing rows: curves that consist of points.
  template <class C, class Read>
  void curves(const char* countsName, const char* pointsName, std::vector<C>& rows, Read read) {
    using Curve = std::remove_cvref_t<decltype(read(rows.front()))>;
    using Point = std::remove_cvref_t<decltype(read(rows.front()).points().front())>;
    std::vector<std::uint32_t> counts;
    std::vector<Point> points;
    for (C& c : rows) {
      const std::vector<Point>& own = read(c).points();
      counts.push_back(static_cast<std::uint32_t>(own.size()));
      points.insert(points.end(), own.begin(), own.end());
    }
    value(countsName, counts), column<double>(pointsName, points);
    if constexpr (Archive::is_loading::value) {
      std::size_t at = 0;
      if (counts.size() != rows.size()) refuse(std::string(countsName) + " has a wrong length");
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (counts[i] > points.size() - at) refuse(std::string(pointsName) + " has a wrong length");
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(at);
        std::vector<Point> own(begin, begin + counts[i]);
        if (!Curve::isValid(own)) refuse(std::string(pointsName) + " is invalid");
        read(rows[i]) = Curve(std::move(own));
        at += counts[i];
      }
    }
  }

  /// For existing rows: the elements of a vector of bool cannot be referenced.
  template <class Element, class Read>
  void flags(const char* name, std::vector<Element>& rows, Read read) {
    std::vector<std::uint8_t> flat(rows.size());
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = read(rows[i]) ? 1 : 0;
    value(name, flat);
    if (flat.size() != rows.size()) refuse(std::string(name) + " has a wrong length");
    for (std::size_t i = 0; i < flat.size(); ++i) read(rows[i]) = flat[i] != 0;
  }

  void surfaces(ContactSurfaces& s) {
    table(s.segmentColumns());
    column<std::uint32_t>("nodeSegment", s.nodeSegment);
    table(s.entryColumns());
  }

  void loads(World& world) {
    std::uint64_t count = world.loads.pressures.size();
    value("pressures", count);
    if (count > world.surfaces.segments()) refuse("its pressures are invalid");
    world.loads.pressures.resize(count);
    for (Pressure& one : world.loads.pressures) {
      column<std::uint32_t>("pressureSegments", one.segments);
      value("pressureFunction", one.function);
      value("pressureFirstNew", one.firstNew);
      table("pressure", one.value);
    }
    column<std::uint32_t>("absorbing", world.loads.absorbing.segments);
  }

  void table(const char* name, TimeTable& table) {
    std::vector<double> times = table.times(), values = table.values();
    value(name, times), value(name, values);
    if constexpr (Archive::is_loading::value) {
      if (!times.empty() || !values.empty())
        if (!TimeTable::isValid(times, values)) refuse(std::string(name) + " is invalid");
      table = TimeTable(std::move(times), std::move(values));
    }
  }

  void contact(Contact& contact) {
    using Index = std::uint32_t;
    Candidates& candidates = contact.candidates;
    column<Index>("slaves", candidates.slaves), column<Index>("offsets", candidates.offsets);
    column<Index>("masters", candidates.masters);
    std::vector<std::uint8_t> unused;  // flags of another rule of entry, in former states
    value("outside", unused);
    auto& rows = contact.touches;
    member("touchSlave", rows, [](Touch& t) -> Index& { return t.pair.slave.value; });
    member("touchMaster", rows, [](Touch& t) -> Index& { return t.pair.master.value; });
    member("touchNormal", rows, [](Touch& t) -> double& { return t.normalForce; });
    member("touchTangent", rows, [](Touch& t) -> double& { return t.tangentForce; });
    member("touchAllowed", rows, [](Touch& t) -> double& { return t.toleratedGap; });
    value("lastCorrection", contact.lastCorrection);
  }

  void search(World& world) {
    SearchState& search = world.search;
    value("halo", search.halo), value("shortest", search.shortest);
    bool isDue = search.isDue(), isVoid = search.isVoid();
    value("isDue", isDue), value("isVoid", isVoid);
    if constexpr (Archive::is_loading::value) {
      using enum SearchState::Validity;
      search.validity = isVoid ? kVoid : isDue ? kDue : kValid;
    }
    column<std::uint32_t>("searchNodes", search.nodes);
    column<double>("searchPositions", search.positions);
    SearchBounds bounds = world.searchBounds();
    value("searchFarthest", bounds.farthest), value("searchSpare", bounds.spare);
    value("searchSpeed", bounds.speed);
    if constexpr (Archive::is_loading::value) search.loaded = bounds;
  }

  void fracture(Fracture& fracture) {
    using Index = std::uint32_t;
    CrackEdges& edges = fracture.edges;
    const auto isLate = [](std::string_view name) {
      return name == "crackEnergy" || name == "cracked";
    };
    table(edges.columns(), std::not_fn(isLate));
    value("crackStart", fracture.started);
    auto& overloads = fracture.overloads;
    member("overloadEdge", overloads, [](Overload& o) -> Index& { return o.edge.value; });
    member("overloadSince", overloads, [](Overload& o) -> double& { return o.since; });
    table(edges.columns(), isLate);
    column<Index>("elementEdges", edges.ofElement), column<Index>("nodeElement", edges.ofNode);
    table(fracture.cohesion.columns());
    std::uint64_t numCracks = fracture.numCracks();
    value("numCracks", numCracks);
    fracture.restore(numCracks);
  }

  Archive& archive_;
  Checksum sum_;
};

}  // namespace yadefrag
