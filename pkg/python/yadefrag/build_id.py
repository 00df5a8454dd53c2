"""The build id of YADE's library: the linker's checksum of one build. Also for pkg/yade/tools/make_table.py, without YADE."""

import pathlib

_NOTE = b'\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0'  # length of the name, of the id; kind of note; name
_BEGIN = 1 << 16                                # bytes of the file in which linkers put it


def buildId(libraries: str) -> str:
    """Of libyade.so in the folder `libraries`; '' if there is none, or it was linked without one."""
    try:
        with (pathlib.Path(libraries) / 'libyade.so').open('rb') as file:
            begin = file.read(_BEGIN)
    except OSError:
        return ''
    return begin.partition(_NOTE)[2][:20].hex()
