# `cmake --install`: the Python package, documents and examples. `cpack`: the same as a .deb for the
# release of the machine.

set(doc_dir share/doc/yadefrag)
install(FILES README.md CHANGELOG.md DESTINATION ${doc_dir} COMPONENT plugin)
install(FILES LICENSE DESTINATION ${doc_dir} RENAME copyright COMPONENT plugin)
install(DIRECTORY examples DESTINATION ${doc_dir} COMPONENT plugin
        PATTERN __pycache__ EXCLUDE PATTERN out EXCLUDE)
if(EXISTS ${PROJECT_SOURCE_DIR}/docs)
  install(DIRECTORY docs DESTINATION ${doc_dir} COMPONENT plugin)
endif()

if(NOT TARGET _yadefrag)
  return()
endif()

file(STRINGS /etc/os-release os_lines REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9.]" "" os_version "${os_lines}")
file(STRINGS /etc/os-release is_forky REGEX "^VERSION_CODENAME=forky")
if(is_forky)
  set(os_version 14)  # it has no number there before its release
endif()
execute_process(COMMAND dpkg-query -W -f "\${source:Upstream-Version}" libyade
                OUTPUT_VARIABLE yade_upstream ERROR_QUIET)
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")

set(CPACK_GENERATOR DEB)
# Without tests and without the headers of lib.
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};yadefrag;plugin;/")
set(CPACK_PACKAGE_NAME yadefrag)
set(CPACK_PACKAGE_VERSION ${YADEFRAG_VERSION})
set(CPACK_PACKAGE_CONTACT "The authors of yadefrag <yadefrag@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "contact search and fracturing finite-element bodies for YADE")
set(CPACK_PACKAGE_DESCRIPTION
    "Contact search on a space-filling curve, and plane bodies of finite elements that deform,
 touch and shatter, as a plugin for the yade of this release: import yadefrag in a script.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~deb${os_version})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The yade and the Python of the build; libraries to which the extension is linked.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${YADEFRAG_YADE_LIBDIR})
set(python_version ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS
       "yade (>= ${yade_upstream}), yade (<< ${yade_upstream}.~)"
       "python3 (>= ${python_version}~), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor}~)"
       "python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, python3-meshio, python3-pil, python3-scipy, python3-shapely, python3-tqdm")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "python3-cssselect2, python3-distributed, python3-ezdxf, python3-skimage, python3-svgelements")
# Python's compiled files are created at the installation and removed with the package.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst
                                       ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
