#pragma once
// State of the simulation loop: whether it runs, in which thread, and the end of its last step.

#include <string>

#include "yade/yade.hpp"

namespace yadefrag {

/// True if this thread is within a step of the scene, e.g. in a PyRunner's command.
bool isInStep();

/// Must be called before the scene changes. Waits for the end of the last step of a paused run,
/// which YADE's O.wait() does not. Throws std::runtime_error if another thread runs the scene.
void requirePaused();

/// Calls run(scene, steps), YADE's O.run(), and returns when its thread is in its first step:
/// before that, YADE must not stop or reset the run, since its thread would find its loop
/// destroyed. Then calls wait(scene), YADE's O.wait(), unless it is None. Python's lock is kept
/// until then, so that no engine that needs it, such as a PyRunner, can fail before YADE waits for
/// its error.
void beginRun(const yade::py::object& run, const yade::py::object& wait,
              const yade::py::object& scene, const yade::py::object& steps);

/// Stops a run of another thread; returns after its last step. Python's lock is released meanwhile.
void stopRun();
/// Stores the reason why an engine has stopped the run, for the message to the script: YADE writes
/// the reason to stderr only. If a script waits for the run, YADE's lines about it are not written.
void noteStop(const char* why);
/// The reason stored since the last call; empty: none.
[[nodiscard]] std::string whyStopped();

/// Waits for the end of a run, if there is one, with Python's lock released, for some hundredths of
/// a second; does nothing within a step. False: the run goes on.
bool waitForEnd();

}  // namespace yadefrag
