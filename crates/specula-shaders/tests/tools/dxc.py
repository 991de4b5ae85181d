# Compiles HLSL with the DXC that the package `compushady` carries: dxc.py FILE ENTRY PROFILE.

import ctypes
import os
import platform
import sys

import compushady.backends as backends

DXIL = 0
folder = list(backends.__path__)[0]
library = os.path.join(folder, f"libdxcompiler_{platform.machine()}.so.3.7")
ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
from compushady.backends import dxc  # noqa: E402 (needs the library)

file, entry, profile = sys.argv[1:]
with open(file, encoding="utf-8") as source:
    compiled = dxc.compile(source.read(), entry, DXIL, profile)
print(len(compiled), "bytes of DXIL")
