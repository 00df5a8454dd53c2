# YADEFRAG_YADE_LIBDIR: folder of YADE's shared libraries. Below YADE_PREFIX there is one for each installed YADE.

set(YADEFRAG_YADE_LIBDIR "" CACHE PATH "Folder of YADE's shared libraries; empty: that of YADE_PREFIX, or of the system")
if(YADE_SOURCE AND NOT YADE_PREFIX)
  message(FATAL_ERROR "YADE_SOURCE needs YADE_PREFIX, the folder where the YADE built from it is installed.")
endif()
# Only what was given is in the cache: another YADE_PREFIX must not keep the folder of the former one.
if(NOT YADEFRAG_YADE_LIBDIR AND YADE_PREFIX)
  file(GLOB configs ${YADE_PREFIX}/lib/yade*/py/yade/config.py ${YADE_PREFIX}/lib/*/yade*/py/yade/config.py)
  list(LENGTH configs number)
  if(NOT number EQUAL 1)
    list(JOIN configs " " configs)
    message(FATAL_ERROR "YADE_PREFIX=${YADE_PREFIX} has ${number} installed YADEs (lib/yade*/py/yade/config.py), and one "
                        "is needed; -DYADEFRAG_YADE_LIBDIR=FOLDER chooses. ${configs}")
  endif()
  string(REGEX REPLACE "/py/yade/config.py$" "" YADEFRAG_YADE_LIBDIR "${configs}")
elseif(NOT YADEFRAG_YADE_LIBDIR)
  set(YADEFRAG_YADE_LIBDIR /usr/lib/x86_64-linux-gnu/yade-double)
endif()
