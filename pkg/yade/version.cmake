# YADE version of the build: that of YADEFRAG_YADE_LIBDIR, if pkg/yade/versions has a file for it.
# Makes the table of its layout and sets YADEFRAG_YADE_VERSION, which stays empty for an unknown
# one.

set(YADEFRAG_YADE_VERSION "")
set(yade_unused_sources "")
set(yade_config ${YADEFRAG_YADE_LIBDIR}/py/yade/config.py)
set(found_version "")
if(EXISTS ${yade_config})
  file(STRINGS ${yade_config} line REGEX "^version *= *'" LIMIT_COUNT 1)
  string(REGEX REPLACE "^version *= *'([^']*)'.*" "\\1" found_version "${line}")
endif()

execute_process(
  COMMAND ${Python3_EXECUTABLE} ${abi_dir}/tools/make_table.py "${found_version}" ${YADEFRAG_VERSION}
          ${generated_dir}/yade ${package_dir}/_built.py ${YADEFRAG_YADE_LIBDIR}
  OUTPUT_VARIABLE reason OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failed)
file(GLOB version_files CONFIGURE_DEPENDS ${abi_dir}/versions/*.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${version_files} ${yade_config}
                                       ${abi_dir}/tools/make_table.py)
if(failed)
  message(WARNING "pkg skipped: ${reason}")
else()
  set(YADEFRAG_YADE_VERSION ${found_version})
endif()

# The target yadefrag_abi checks that the virtual functions of pkg/yade are in YADE's order, from the
# compiler's dump of the declarations; no code is generated.
function(yadefrag_check_virtuals)
  set(dump ${CMAKE_CURRENT_BINARY_DIR}/abi_classes.txt)
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/abi_checked)
  file(GLOB declarations CONFIGURE_DEPENDS ${abi_dir}/*.hpp)
  set(folders ${eigen_dirs} ${Boost_INCLUDE_DIRS} ${Python3_INCLUDE_DIRS})
  list(REMOVE_ITEM folders /usr/include)  # the compiler's own folder, with its own position in the search order
  list(TRANSFORM folders PREPEND -isystem)
  add_custom_command(
    OUTPUT ${stamp}
    COMMAND
      ${CMAKE_CXX_COMPILER} -std=c++20 -w -fsyntax-only -fdump-lang-class=${dump}
      "-D$<JOIN:$<TARGET_PROPERTY:yadefrag_pkg_options,INTERFACE_COMPILE_DEFINITIONS>,;-D>"
      -I${CMAKE_CURRENT_SOURCE_DIR} -I${generated_dir} ${folders} ${abi_dir}/layout_checks.cpp
    COMMAND ${Python3_EXECUTABLE} ${abi_dir}/tools/check_virtuals.py ${YADEFRAG_YADE_VERSION} ${dump}
            ${stamp}
    DEPENDS ${declarations} ${abi_dir}/layout_checks.cpp ${version_files}
            ${abi_dir}/tools/check_virtuals.py ${CMAKE_CURRENT_SOURCE_DIR}/yade/archives.hpp
    COMMENT "Comparing the virtual functions of pkg/yade with those of YADE ${YADEFRAG_YADE_VERSION}"
    COMMAND_EXPAND_LISTS VERBATIM)
  add_custom_target(yadefrag_abi DEPENDS ${stamp})
endfunction()

# yadefrag_use_yade(options): the features of Debian's packages, with the declarations of pkg/yade.
function(yadefrag_use_yade options)
  target_compile_definitions(
    ${options} INTERFACE EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN BOOST_BIND_GLOBAL_PLACEHOLDERS YADE_MPI
                         YADE_OPENGL YADE_OPENMP)
  yadefrag_check_headers(${CMAKE_CURRENT_SOURCE_DIR} ${options})
  yadefrag_check_virtuals()
endfunction()
