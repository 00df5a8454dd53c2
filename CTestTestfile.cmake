# `ctest` in this folder runs the tests of a build below it: of `cmake -B build`, else of the scripts.
# (Paths are relative: ctest sets no variable for this file's folder.)
foreach(folder build build/release)
  if(EXISTS ${folder}/CTestTestfile.cmake)
    subdirs(${folder})
    break()
  endif()
endforeach()
