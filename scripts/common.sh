# Sourced by every script here: the project's folder, and errors with one sentence.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=/usr/bin/python3
# Debian's tools have priority over those of pyenv or conda.
export PATH="/usr/sbin:/usr/bin:/sbin:/bin:$PATH"
unset PYTHONHOME VIRTUAL_ENV CONDA_PREFIX

die() {
  echo "scripts/$(basename "$0"): $*" >&2
  exit 1
}

# YADE_PREFIX: where a YADE that its user built is installed (YADE_SOURCE: its sources, if they have moved). The
# plugin for it has a build folder of its own; otherwise YADE is that of the system.
release_dir=$root/build/release
yade=/usr/bin/yade
if [ -n "${YADE_PREFIX:-}" ]; then
  release_dir=$root/build/own
  yade=$(find "$YADE_PREFIX/bin" -name 'yade*' ! -name '*-batch' ! -name '*.py' 2>/dev/null | sort | tail -n 1) || true
  [ -n "$yade" ] || die "YADE_PREFIX=$YADE_PREFIX has no bin/yade*: no YADE is installed there."
fi

# The project's own runs use Debian's Python packages only.
use_only_debian_python() {
  export PYTHONNOUSERSITE=1
  unset PYTHONPATH PYTHONSTARTUP
}

# Processes started from here find `import yadefrag`; it is built first if it does not exist.
use_plugin() {
  local package_dir=$release_dir/python
  if [ ! -e "$package_dir/yadefrag/__init__.py" ] || [ ! -e "$package_dir/yadefrag/_yadefrag.so" ]; then
    make_plugin plugin >&2
  fi
  export PYTHONPATH="$package_dir${PYTHONPATH:+:$PYTHONPATH}"
}

# Where the plugin is installed in the YADE below YADE_PREFIX, which finds it there before any other one.
installed_plugin() {
  [ -z "${YADE_PREFIX:-}" ] || find "$YADE_PREFIX"/lib*/ -maxdepth 4 -path '*/yade*/py/yadefrag' | head -n 1
}

jobs_at_once() { echo "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"; }

# Packages that the compiler does not need take half of the time of all: they are installed while it works.
# $1: plugin, or nothing for those of tests, too.
make_plugin() {
  local rest result=0
  "$root/scripts/setup" compile || return
  "$root/scripts/setup" "$@" &
  rest=$!
  "$root/scripts/build" release _yadefrag || result=1
  wait "$rest" && return "$result"
}
