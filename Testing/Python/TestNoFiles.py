# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters, the plugin and the Python module open no file, start no program and no connection: they import no
function that could. The writers of glTF and 3MF, whose files are left out, may.

usage: TestNoFiles.py PROGRAM_THAT_WRITES_A_FILE LIBRARY_OR_OBJECT...
"""
import re
import shutil
import subprocess
import sys

NAMES = """open open64 openat creat fopen fopen64 freopen tmpfile mkstemp mkdtemp mkdir rmdir unlink remove rename link
symlink chmod truncate opendir system popen fork vfork clone posix_spawn posix_spawnp execl execlp execle execv execve
execvp dlopen dlmopen socket connect""".split()
# C++: file streams and std::filesystem; readers and writers, of files and programs, of VTK and Qt.
MANGLED = r"_ZNK?St\w*basic_[io]?f(stream|ilebuf)|_ZNK?St10filesystem|" \
          r"_ZN\d+vtk(?!StyleGLTFWriter|3MFWriter)\w*(Reader|Writer)\w*3NewE|" \
          r"_ZN(5QFile|8QProcess|4QDir)|vtksysProcess|_ZN6vtksys11SystemTools\d+(Fopen|Make|Remove|Copy|Rename|Touch)"


def forbidden(file):
    """What the file imports of these. Readers and writers count where they are made."""
    of_object = [] if file.endswith((".o", ".a")) else ["--dynamic"]
    listing = subprocess.run([NM, *of_object, "--undefined-only", file], check=True, capture_output=True,
                             text=True).stdout
    imported = {line.split()[-1].split("@")[0] for line in listing.splitlines() if line and not line.endswith(":")}
    assert len(imported) > (5 if of_object == [] else 20), (file, imported)
    return sorted(name for name in imported if name in NAMES or re.match(MANGLED, name))


NM = shutil.which("nm")
if NM is None:
    print("nm (binutils) is not there")
    sys.exit(77)
assert any("basic_ofstream" in name or "basic_filebuf" in name for name in forbidden(sys.argv[1])), "a program that does"
for library in sys.argv[2:]:
    assert not forbidden(library), (library, forbidden(library))
    print(library, "imports nothing of the kind")
assert any(library.endswith(".o") for library in sys.argv[2:]), "the objects of the filters"
