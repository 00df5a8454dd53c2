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

# The project's own runs use Debian's Python packages only.
use_only_debian_python() {
  export PYTHONNOUSERSITE=1
  unset PYTHONPATH PYTHONSTARTUP
}

# Processes started from here find `import yadefrag`; it is built first if it does not exist.
use_plugin() {
  local package_dir=$root/build/release/python
  if [ ! -e "$package_dir/yadefrag/__init__.py" ] || [ ! -e "$package_dir/yadefrag/_yadefrag.so" ]; then
    "$root/scripts/setup" plugin >&2
    "$root/scripts/build" release _yadefrag >&2
  fi
  export PYTHONPATH="$package_dir${PYTHONPATH:+:$PYTHONPATH}"
}

jobs_at_once() { echo "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"; }
