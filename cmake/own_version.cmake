# YADEFRAG_VERSION: 0.1.0 at the tag v0.1.0; between tags with number of commits and the commit, e.g.
# 0.1.0+12.gabcdef0; without git the version in project().

set(YADEFRAG_VERSION ${PROJECT_VERSION})
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM)
  execute_process(
    COMMAND ${GIT_PROGRAM} -c safe.directory=* describe --tags --match "v[0-9]*" --long --abbrev=7
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(
    COMMAND ${GIT_PROGRAM} -c safe.directory=* rev-parse --short=7 HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(described MATCHES "^v(.+)-0-g[0-9a-f]+$")
    set(YADEFRAG_VERSION ${CMAKE_MATCH_1})
  elseif(described MATCHES "^v(.+)-([0-9]+)-(g[0-9a-f]+)$")
    set(YADEFRAG_VERSION ${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
  elseif(commit)
    set(YADEFRAG_VERSION ${PROJECT_VERSION}+g${commit})
  endif()
endif()
