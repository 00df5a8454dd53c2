#pragma once
// Does the scene run, in which thread, and when is its last step over.

#include <string>

namespace yadefrag {

/// Is this thread within a step of the scene, as a PyRunner's command is.
bool isInStep();

/// To be called before the scene changes. Waits until the last step of a run that was paused is
/// over: YADE's O.wait() does not. Throws std::runtime_error if another thread runs the scene.
void requirePaused();

/// To be called after a run was begun: returns once its thread is in its first step. Until then
/// YADE must not be told to stop or reset, for its thread would find its own loop destroyed. `iter`
/// and `subStep` are those of the scene before.
void waitForStart(long iter, int subStep);

/// Stops a run of another thread; returns after its last step. Python's lock is given up meanwhile.
void stopRun();
/// Why an engine has stopped the run: kept for the sentence that a script gets, for YADE writes it
/// to stderr only.
void noteStop(const char* why);
/// What has been noted since the last call; empty: nothing.
[[nodiscard]] std::string whyStopped();

/// Waits for the end of a run, if there is one, with Python's lock given up; does nothing in a
/// step.
void waitForEnd();

}  // namespace yadefrag
