"""Converts roundel.h for cffi: plain C declarations without preprocessor directives.

The conditions in the header only ask for C++, for C23 and whether it was included before. So neither a
preprocessor nor a compiler is needed.
"""

import re

from build_root import ROOT

HEADER = ROOT / "include" / "roundel" / "roundel.h"

#: Every condition in the header, with its value for a C99 compiler.
CONDITIONS = {
    "#ifndef ROUNDEL_H": True,
    "#ifdef __cplusplus": False,
    "#ifndef __cplusplus": True,
    "#if __STDC_VERSION__ >= 202311L": False,
    "#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L": False,
}


def declarations() -> str:
    """The header's declarations and numeric constants.

    Raises KeyError for a condition that is not in CONDITIONS.
    """
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.DOTALL)
    kept, stack = [], []
    for line in re.sub(r"//.*", "", text).splitlines():
        line = line.strip()
        if line.startswith("#if"):
            stack.append(CONDITIONS[line])
        elif line.startswith("#else"):
            stack[-1] = not stack[-1]
        elif line.startswith("#endif"):
            stack.pop()
        elif all(stack) and line and line != "#define ROUNDEL_H" and "#include" not in line:
            kept.append(line)
    return "\n".join(kept) + "\n"
