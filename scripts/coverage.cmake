# Included by CMakeLists.txt for scripts/coverage: counts the lines of what is measured, and only there.
foreach(target
    grasp_affordances_core grasp_affordances_core_objects grasp_affordances_core_portable
    grasp_affordances_cameras grasp_affordances_nodelets grasp_affordances_ros
    localizer_node multi_camera_node pcd_publisher xtion_node)
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE -O1 --coverage -fprofile-update=prefer-atomic
      "-fprofile-filter-files=/(include/grasp_affordances|src/core|src/nodelets)/")
    target_link_options(${target} PRIVATE --coverage)
  endif()
endforeach()
