# What yadefrag::core needs of others.
include(CMakeFindDependencyMacro)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(Eigen3 3.4 NO_MODULE)
include(${CMAKE_CURRENT_LIST_DIR}/yadefragTargets.cmake)
set_property(TARGET yadefrag::core APPEND PROPERTY INTERFACE_LINK_LIBRARIES Eigen3::Eigen)
