# What yadefrag::core needs of others.
include(CMakeFindDependencyMacro)
find_dependency(OpenMP COMPONENTS CXX)
# A version given here would have to be of Eigen's own major version, as in lib/CMakeLists.txt.
find_dependency(Eigen3 NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.4)
  set(yadefrag_FOUND FALSE)
  set(yadefrag_NOT_FOUND_MESSAGE "Eigen ${Eigen3_VERSION} is too old: 3.4 or later is needed")
  return()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/yadefragTargets.cmake)
set_property(TARGET yadefrag::core APPEND PROPERTY INTERFACE_LINK_LIBRARIES Eigen3::Eigen)
