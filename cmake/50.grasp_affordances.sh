# Puts localize, simulate and evaluate onto the PATH. They stay where rosrun looks for them, below lib. The setup files
# of catkin read this file and set CATKIN_ENV_HOOK_WORKSPACE: the devel or install space that it belongs to.
_tools="$CATKIN_ENV_HOOK_WORKSPACE/lib/grasp_affordances"
_path=":$PATH:"
case "$_path" in
  *":$_tools:"*) _path="${_path%%":$_tools:"*}:${_path#*":$_tools:"}" ;;  # the setup file is read once more
esac
_path="${_path#:}"
export PATH="$_tools:${_path%:}"
unset _tools _path
