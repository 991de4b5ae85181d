# Compiles HLSL to SPIR-V with the DXC that the package `compushady` carries: dxc.py FILE OUTPUT.

import ctypes
import os
import platform
import sys

import compushady.backends as backends

SPIRV = 1
folder = list(backends.__path__)[0]
library = os.path.join(folder, f"libdxcompiler_{platform.machine()}.so.3.7")
ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
from compushady.backends import dxc  # noqa: E402 (needs the library)

file, output = sys.argv[1:]
with open(file, encoding="utf-8") as source:
    compiled = dxc.compile(source.read(), "", SPIRV, "lib_6_3")
with open(output, "wb") as written:
    written.write(bytes(compiled))
