"""Where LLVM is, for Dr.Jit."""

from __future__ import annotations

import glob
import os
import re


def find() -> None:
    """Name the newest LLVM of Debian's in ``DRJIT_LIBLLVM_PATH``, unless that is set.

    Dr.Jit looks for a libLLVM without version and needs 15 or newer; Debian's carry versions.
    """
    if "DRJIT_LIBLLVM_PATH" in os.environ:
        return
    found: dict[int, str] = {}
    for pattern in ("/usr/lib/llvm-*/lib/libLLVM*.so*", "/usr/lib/*-linux-gnu/libLLVM*.so*"):
        for path in glob.glob(pattern):
            version = re.search(r"(?:llvm-|libLLVM-|libLLVM\.so\.)(\d+)", path)
            if version and int(version[1]) >= 15:
                found[int(version[1])] = path
    if found:
        os.environ["DRJIT_LIBLLVM_PATH"] = found[max(found)]
