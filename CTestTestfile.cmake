# `ctest` in this folder runs the tests of a build below it: of `cmake -B build`, else of the scripts.
foreach(folder build build/release)
  if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/${folder}/CTestTestfile.cmake)
    subdirs(${CMAKE_CURRENT_LIST_DIR}/${folder})
    break()
  endif()
endforeach()
