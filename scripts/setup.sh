# shellcheck shell=bash
# Sourced by the scripts that build: installs what is missing, builds what is stale. A script may set its own `build`
# folder and `configure_options` of cmake after that.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
configure_options=()

# Debian's python3 is the one that has ROS; another one may come first on the PATH.
export PATH=/usr/bin:$PATH

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

install_packages() {
  local packages missing=() package
  mapfile -t packages < <(grep '^[^#]' "$root/scripts/packages")
  for package in "${packages[@]}"; do
    if ! dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
}

# Ninja, where it is installed, keeps all processors busier than make does. A folder that make builds in stays make's.
choose_generator() {
  if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi
}

# build_targets TARGET...: in $build, the devel space in $build/devel.
build_targets() {
  local log=$build/configure.log
  choose_generator
  # The environment of the tests has the paths of those folders only that exist when catkin is configured.
  mkdir -p "$build/devel/lib/python3/dist-packages"
  echo "Building in ${build/#$PWD\//}"
  if ! cmake -S "$root" -B "$build" -DCATKIN_DEVEL_PREFIX="$build/devel" -DCATKIN_ENABLE_TESTING=ON \
      -DPYTHON_EXECUTABLE=/usr/bin/python3 "${configure_options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
  cmake --build "$build" --parallel "$(nproc)" --target "$@"
}

# What the tests of ROS, and those on recorded clouds, find in their environment.
export_test_environment() {
  export ROS_IP=127.0.0.1
  if [ -n "${GRASP_AFFORDANCES_DATA:-}" ]; then
    GRASP_AFFORDANCES_DATA=$(realpath -m -- "$GRASP_AFFORDANCES_DATA")  # the tests run elsewhere
    export GRASP_AFFORDANCES_DATA
  fi
}
