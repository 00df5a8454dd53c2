# The library as others use it: installed, found by find_package, and its example built and run.
#   cmake -DBUILD=... -DEXAMPLE=... -DFOLDER=... -DCOMPILER=... -DGENERATOR=... -P try_library.cmake

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${FOLDER}/installed)
# The same generator: a machine with Ninja may have no make.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${EXAMPLE} -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/installed
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/bars)
message(STATUS "${output}")

# Nothing of the source tree is in what was installed: it may be moved.
file(GLOB_RECURSE files ${FOLDER}/installed/*.cmake)
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(FIND "${text}" "${SOURCE}" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${file} names ${SOURCE}")
  endif()
endforeach()

# Bars of the same kind exchange their speeds. 1.5 % of 10 m/s stays in their ringing, as in
# step/bars_test.cpp.
if(NOT output MATCHES "left (-?[0-9.]+) m/s, right ([0-9.]+) m/s")
  message(FATAL_ERROR "no speeds in: ${output}")
endif()
if(CMAKE_MATCH_1 GREATER 0.15 OR CMAKE_MATCH_1 LESS -0.15 OR CMAKE_MATCH_2 GREATER 10.15
   OR CMAKE_MATCH_2 LESS 9.85)
  message(FATAL_ERROR "the bars have not exchanged their speeds: ${output}")
endif()
