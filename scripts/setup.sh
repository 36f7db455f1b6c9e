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

# Where ROS is not Debian's: the newest one of /opt/ros, in case none has been chosen by its setup file.
ros_of_its_own() { compgen -G '/opt/ros/*/setup.bash' >/dev/null; }
if ros_of_its_own && [ -z "${ROS_DISTRO:-}" ]; then
  ros_setups=(/opt/ros/*/setup.bash)
  set +u  # catkin's setup file reads variables that may be unset
  # shellcheck source=/dev/null
  source "${ros_setups[-1]}"
  set -u
fi

installed() { dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }

# Whether the release has such a package, as far as apt knows.
in_release() { LC_ALL=C apt-cache policy "$1" 2>/dev/null | grep '^  Candidate: [^(]' >/dev/null; }

apt_install() { as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$@" >/dev/null; }

# in_release_of_line "A | B: what is left out": prints the first that the release has.
in_release_of_line() {
  local name
  for name in ${1%%:*}; do
    if [ "$name" != '|' ] && in_release "$name"; then echo "$name" && return; fi
  done
  return 1
}

any_installed() {
  local name
  for name in ${1%%:*}; do
    if [ "$name" != '|' ] && installed "$name"; then return; fi
  done
  return 1
}

# Installs what is missing of the lists in scripts/packages: first what is needed, then what is optional. Of that, what the
# release does not have, or apt cannot install, is left out, and one line says so.
install_packages() {
  local needed=(needed) optional=(optional) missing=() wanted=() packages=() left_out=() line package
  if ros_of_its_own; then
    echo "ROS is that of /opt/ros, $ROS_DISTRO: nothing of ROS is installed from Debian"
  else
    needed+=(ros)
    optional+=(optional_ros)
  fi
  while read -r package; do
    if ! installed "$package"; then missing+=("$package"); fi
  done < <(cd "$root/scripts/packages" && grep -h '^[^#]' "${needed[@]}")
  while read -r line; do
    if ! any_installed "$line"; then wanted+=("$line"); fi
  done < <(cd "$root/scripts/packages" && grep -h '^[^#]' "${optional[@]}")

  if [ ${#missing[@]} -gt 0 ]; then
    echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
    as_root apt-get update -qq
    apt_install "${missing[@]}"
  elif [ ${#wanted[@]} -gt 0 ] && ! compgen -G '/var/lib/apt/lists/*Packages*' >/dev/null; then
    as_root apt-get update -qq
  fi

  missing=()
  for line in "${wanted[@]}"; do
    if package=$(in_release_of_line "$line"); then
      missing+=("$line")
      packages+=("$package")
    else
      left_out+=("$line")
    fi
  done
  if [ ${#packages[@]} -gt 0 ]; then
    echo "Installing ${#packages[@]} optional Debian packages: ${packages[*]}"
    if ! apt_install "${packages[@]}"; then  # perhaps only one of them cannot be installed
      for line in "${missing[@]}"; do
        apt_install "$(in_release_of_line "$line")" || left_out+=("$line")
      done
    fi
  fi
  if [ ${#left_out[@]} -gt 0 ]; then
    echo "Left out, as this release does not have their packages: $(printf '%s\n' "${left_out[@]}" |
      awk -F ': ' '{ text = text separator $2 " (" $1 ")"; separator = "; " } END { print text }')"
  fi
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

# Whether the configuration of $build has such a target.
has_target() { cmake --build "$build" --target help | grep -w "$1" >/dev/null; }

# What the tests of ROS, and those on recorded clouds, find in their environment.
export_test_environment() {
  export ROS_IP=127.0.0.1
  if [ -n "${GRASP_AFFORDANCES_DATA:-}" ]; then
    GRASP_AFFORDANCES_DATA=$(realpath -m -- "$GRASP_AFFORDANCES_DATA")  # the tests run elsewhere
    export GRASP_AFFORDANCES_DATA
  fi
}
