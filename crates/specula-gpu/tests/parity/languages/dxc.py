# Compiles HLSL to SPIR-V with the DXC of the package `compushady`: dxc.py FILE OUTPUT ARGUMENTS.
#
# The package's own function takes no arguments of DXC, so that its library is called here:
# interfaces of COM, each a table of functions, which on Linux begins with those of `IUnknown`
# and two destructors.

import ctypes
import os
import platform
import sys
import uuid

import compushady.backends as backends

COMPILER = "73e22d93-e6ce-47f3-b5bf-f0664f39c1b0"
COMPILER3 = "228b4687-5a6a-4730-900c-9702b2203f54"
RESULT = "58346cda-dde7-4497-9461-6f87af5e0659"
# The first function of an interface behind those of `IUnknown`.
FIRST = 5
UTF8 = 65001
Pointer = ctypes.c_void_p


class Buffer(ctypes.Structure):
    _fields_ = [("text", ctypes.c_char_p), ("size", ctypes.c_size_t), ("code", ctypes.c_uint32)]


def identifier(text):
    return ctypes.create_string_buffer(uuid.UUID(text).bytes_le, 16)


def call(interface, place, result, *arguments):
    """Calls a function of an interface; arguments are numbers and pointers."""
    table = ctypes.cast(interface, ctypes.POINTER(ctypes.POINTER(Pointer)))[0]
    types = [ctypes.c_uint32 if isinstance(a, int) else Pointer for a in arguments]
    function = ctypes.CFUNCTYPE(result, Pointer, *types)(table[FIRST + place])
    return function(interface, *arguments)


def blob(interface, place):
    """The bytes that a function of an interface gives."""
    found = Pointer()
    call(interface, place, ctypes.c_int32, ctypes.byref(found))
    if not found:
        return b""
    return ctypes.string_at(call(found, 0, Pointer), call(found, 1, ctypes.c_size_t))


folder = list(backends.__path__)[0]
library = ctypes.CDLL(os.path.join(folder, f"libdxcompiler_{platform.machine()}.so.3.7"))
compiler = Pointer()
library.DxcCreateInstance(identifier(COMPILER), identifier(COMPILER3), ctypes.byref(compiler))

file, output, *words = sys.argv[1:]
with open(file, "rb") as source:
    text = source.read()
source = Buffer(text, len(text), UTF8)
arguments = (ctypes.c_wchar_p * len(words))(*words)
result = Pointer()
compile_place, status_place, object_place, errors_place = 0, 0, 1, 2
call(
    compiler,
    compile_place,
    ctypes.c_int32,
    ctypes.byref(source),
    arguments,
    len(words),
    None,
    identifier(RESULT),
    ctypes.byref(result),
)
status = ctypes.c_int32()
call(result, status_place, ctypes.c_int32, ctypes.byref(status))
if status.value != 0:
    sys.exit(blob(result, errors_place).decode())
with open(output, "wb") as written:
    written.write(blob(result, object_place))
