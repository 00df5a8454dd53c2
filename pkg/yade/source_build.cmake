# A YADE that its user built (YADE_PREFIX): its own headers, with the flags of its features, instead of pkg/yade.

set(YADEFRAG_YADE_VERSION "")
execute_process(
  COMMAND ${Python3_EXECUTABLE} ${abi_dir}/tools/yade_build.py ${YADEFRAG_YADE_LIBDIR} ${YADE_SOURCE}
  OUTPUT_VARIABLE answer OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "No plugin can be built: ${answer}")
endif()
string(REPLACE "\n" ";" yade_flags "${answer}")
list(POP_FRONT yade_flags found_version yade_source yade_features yade_command)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${YADEFRAG_YADE_LIBDIR}/py/yade/config.py
                                       ${abi_dir}/tools/yade_build.py ${abi_dir}/tools/make_table.py)
execute_process(
  COMMAND ${Python3_EXECUTABLE} ${abi_dir}/tools/make_table.py --source "${yade_source}" "${yade_features}"
          ${YADE_PREFIX}/bin/${yade_command} "${found_version}" ${YADEFRAG_VERSION} ${generated_dir}/yade ${package_dir}/_built.py
          ${YADEFRAG_YADE_LIBDIR}
  COMMAND_ERROR_IS_FATAL ANY)
set(YADEFRAG_YADE_VERSION ${found_version})
message(STATUS "YADE ${found_version} in ${YADE_PREFIX}, with the headers in ${yade_source}")

# No table of layouts to compare with; a YADE without a 3D view lacks the base of what draws.
set(yade_unused_sources ${abi_dir}/layout_checks.cpp)
if(NOT yade_features MATCHES "QT5")
  list(APPEND yade_unused_sources ${CMAKE_CURRENT_SOURCE_DIR}/bindings/body_picture.cpp)
endif()

# yadefrag_use_yade(options): YADE's headers, which include those of its features' libraries.
function(yadefrag_use_yade options)
  target_compile_definitions(${options} INTERFACE YADEFRAG_YADE_SOURCE)
  target_compile_options(${options} INTERFACE ${yade_flags})
  target_include_directories(${options} SYSTEM INTERFACE ${yade_source})
  if(yade_features MATCHES "MPI")
    find_package(MPI REQUIRED COMPONENTS CXX)
    target_include_directories(${options} SYSTEM INTERFACE ${MPI_CXX_INCLUDE_DIRS})
  endif()
endfunction()
