# YADEFRAG_YADE_LIBDIR: folder of YADE's shared libraries. Below YADE_PREFIX there is one for each installed YADE.

set(libdir /usr/lib/x86_64-linux-gnu/yade-double)
if(YADE_PREFIX)
  file(GLOB configs ${YADE_PREFIX}/lib/yade*/py/yade/config.py ${YADE_PREFIX}/lib/*/yade*/py/yade/config.py)
  list(LENGTH configs number)
  if(NOT number EQUAL 1 AND NOT YADEFRAG_YADE_LIBDIR)
    list(JOIN configs " " configs)
    message(FATAL_ERROR "YADE_PREFIX=${YADE_PREFIX} has ${number} installed YADEs (lib/yade*/py/yade/config.py), and one "
                        "is needed; -DYADEFRAG_YADE_LIBDIR=FOLDER chooses. ${configs}")
  endif()
  string(REGEX REPLACE "/py/yade/config.py$" "" libdir "${configs}")
elseif(YADE_SOURCE)
  message(FATAL_ERROR "YADE_SOURCE needs YADE_PREFIX, the folder where the YADE built from it is installed.")
endif()
set(YADEFRAG_YADE_LIBDIR ${libdir} CACHE PATH "Folder of YADE's shared libraries")
