#include "yade/running.hpp"

#include <unwind.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "yade/gil.hpp"
#include "yade/yade.hpp"

namespace yadefrag {
namespace {

using Clock = std::chrono::steady_clock;

/// A check takes a few microseconds; it delays the end by a sixteenth of the run at most.
constexpr int kRestsPerRun = 16;
/// A script looks for Ctrl-C so often.
constexpr std::chrono::milliseconds kLook(50);

/// The address of a non-virtual member function.
template <class Member>
_Unwind_Ptr addressOf(Member member) {
  _Unwind_Ptr address = 0;
  std::memcpy(&address, &member, sizeof(address));
  return address;
}

_Unwind_Reason_Code findStep(_Unwind_Context* context, void* found) {
  static const _Unwind_Ptr step = addressOf(&yade::Scene::moveToNextTimeStep);
  if (_Unwind_GetRegionStart(context) != step) return _URC_NO_REASON;
  *static_cast<bool*>(found) = true;
  return _URC_NORMAL_STOP;
}

/// Replaces the loop by a new one: YADE destroys the old loop only after its last step.
void replaceLoop() {
  const WithoutGil free;
  yade::Omega::instance().createSimulationLoop();
}

}  // namespace

bool isInStep() {
  bool found = false;
  _Unwind_Backtrace(&findStep, &found);
  return found;
}

void requirePaused() {
  if (isInStep()) return;
  if (yade::Omega::instance().isRunning())
    throw std::runtime_error(
        "The simulation is running: call O.pause() first, or do this from a PyRunner.");
  replaceLoop();
}

namespace {

/// `iter` and `subStep` are the scene's values before the start.
void waitForStart(long iter, int subStep) {
  yade::Omega& omega = yade::Omega::instance();
  const auto hasBegun = [&] {
    const volatile yade::Scene& scene = *omega.getScene();
    return !omega.isRunning() || scene.iter != iter || scene.subStep != subStep;
  };
  while (!hasBegun()) std::this_thread::yield();
}

}  // namespace

void beginRun(const yade::py::object& run, const yade::py::object& wait,
              const yade::py::object& scene, const yade::py::object& steps) {
  // A paused run may still be in its last step: its progress is not that of the new run.
  if (!isInStep() && !yade::Omega::instance().isRunning()) replaceLoop();
  const yade::Scene& before = *yade::Omega::instance().getScene();
  const long iter = before.iter;
  const int subStep = before.subStep;
  const bool isWaiting = wait.ptr() != Py_None;
  run(scene, steps, false);
  // The rest of a failed step may need Python's lock. YADE's O.wait() then lasts long enough, 40
  // ms, for the thread to begin.
  const bool isRest = subStep != -1;
  if (!isInStep() && !(isRest && isWaiting)) {
    std::optional<WithoutGil> free;
    if (isRest) free.emplace();
    waitForStart(iter, subStep);
  }
  if (isWaiting) wait(scene);
}

bool waitForEnd() {
  if (isInStep()) return true;
  const WithoutGil free;
  for (const Clock::time_point start = Clock::now(); yade::Omega::instance().isRunning();) {
    const auto passed = Clock::now() - start;
    if (passed > kLook) return false;
    std::this_thread::sleep_for(
        std::max<Clock::duration>(passed / kRestsPerRun, std::chrono::microseconds(50)));
  }
  return true;
}

void stopRun() {
  yade::Omega::instance().pause();
  if (!isInStep()) replaceLoop();
}

namespace {

std::mutex stopLock;
std::string stopReason;  // written by the scene's thread

}  // namespace

void noteStop(const char* why) {
  {
    const std::lock_guard guard(stopLock);
    stopReason = why;
  }
  const WithGil gil;
  try {
    yade::py::import("yadefrag.scene.lifecycle").attr("silenceRefusal")();
  } catch (const yade::py::error_already_set&) {
    PyErr_Clear();  // YADE's lines are then written, too
  }
}

std::string whyStopped() {
  const std::lock_guard guard(stopLock);
  return std::exchange(stopReason, {});
}

}  // namespace yadefrag
