#!/usr/bin/env python3
"""Copies what the built program needs at run time, and nothing else, into a folder that becomes the image's root.

These are the libraries that the program and its helpers load, those that they open by name (Mesa's software renderer), a font,
certificates and curl (for the health check). Packages that the base image has are left out. With each package go its
copyright file, its entry for scanners of vulnerabilities (/var/lib/dpkg/status.d, as distroless images have it) and its row in
an SPDX list: name, version, license.
usage: runtime_root.py ROOT BASE_PACKAGES PROGRAM...    BASE_PACKAGES: names of the packages of the base image, one per line
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

LIBRARIES = pathlib.Path("/usr/lib/x86_64-linux-gnu")
# Opened by name: the vendor-neutral GL, and Mesa's EGL.
OPENED = [
    "libEGL.so.1",
    "libOpenGL.so.0",
    "libGL.so.1",
    "libGLX.so.0",
    "libEGL_mesa.so.0",
]
FILES = ["/usr/share/glvnd/egl_vendor.d/50_mesa.json", "/usr/bin/curl", "/etc/ssl/certs/ca-certificates.crt"]
FOLDERS = ["/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/opentype/bebas-neue", "/etc/fonts", "/usr/share/fontconfig"]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout


def loaded_by(files):
    """Paths of all libraries that the loader would load for these, as it finds them."""
    found = set()
    for line in output("ldd", *files).splitlines():
        match = re.search(r"=> (/\S+) \(", line) or re.match(r"\s*(/\S+) \(", line)
        if match and not match[1].startswith("/opt/"):
            found.add(match[1])
    return found


def owner_of(path):
    """The package of a file; dpkg may know it by its place before or after /lib was merged into /usr/lib."""
    real = os.path.realpath(path)
    for name in {path, real, real.removeprefix("/usr"), path.removeprefix("/usr")}:
        done = subprocess.run(["dpkg-query", "-S", name], capture_output=True, encoding="utf-8")
        if done.returncode == 0:
            return done.stdout.split(":")[0].split(",")[0]
    return None


def copy_with_links(path, root, copies):
    """The file, and each link on the way to it, at their own places; folders that are links are followed.

    Names of one file stay one file (Mesa's drivers): `copies` leads from its device and number to its copy.
    """
    path = pathlib.Path(os.path.realpath(os.path.dirname(path)), os.path.basename(path))
    target = root / path.relative_to("/")
    if target.exists() or target.is_symlink():
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.is_symlink():
        target.symlink_to(os.readlink(path))
        copy_with_links(os.path.normpath(path.parent / os.readlink(path)), root, copies)
        return
    identity = (path.stat().st_dev, path.stat().st_ino)
    if identity in copies:
        os.link(copies[identity], target)
    else:
        shutil.copy2(path, target)
        copies[identity] = target


def licenses_in(copyright_text):
    """Names of the licenses in a copyright file that machines can read; it holds their texts."""
    if not copyright_text.lstrip().startswith("Format:"):
        return []
    return sorted(set(re.findall(r"^License:[ \t]*(\S[^\n]*?)[ \t]*$", copyright_text, re.M)))


def describe(package, root):
    """Copies the package's papers and returns its row of the SPDX list."""
    control = output("dpkg-query", "-s", package)
    folder = root / "var/lib/dpkg/status.d"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / package).write_text(control, encoding="utf-8")
    papers = pathlib.Path("/usr/share/doc") / package / "copyright"
    text = papers.read_text(errors="replace", encoding="utf-8") if papers.exists() else ""
    if text:
        target = root / papers.relative_to("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    version = re.search(r"^Version: (.*)$", control, re.M)[1]
    return {
        "SPDXID": f"SPDXRef-{re.sub(r'[^A-Za-z0-9.-]', '-', package)}",
        "name": package,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "licenseComments": f"/usr/share/doc/{package}/copyright: {', '.join(licenses_in(text)) or 'as text'}",
        "copyrightText": "NOASSERTION",
        "externalRefs": [
            {
                "referenceCategory": "PACKAGE-MANAGER",
                "referenceType": "purl",
                "referenceLocator": f"pkg:deb/debian/{package}@{version}?distro=bookworm",
            }
        ],
    }


def main(root, base_packages, programs):
    root = pathlib.Path(root)
    base = set(pathlib.Path(base_packages).read_text(encoding="utf-8").split())
    # Mesa's drivers, of software and of GPUs, are names of one file.
    drivers = sorted((LIBRARIES / "dri").glob("*_dri.so"))
    opened = [str(path) for path in [*map(LIBRARIES.joinpath, OPENED), *drivers] if path.exists()]
    wanted = loaded_by([*programs, *opened, "/usr/bin/curl"]) | set(opened) | set(FILES)
    for folder in FOLDERS:
        wanted |= {str(file) for file in pathlib.Path(folder).rglob("*") if file.is_file() or file.is_symlink()}
    packages, copies = set(), {}
    for path in sorted(wanted):
        package = owner_of(path)
        if package in base:
            continue
        if package:
            packages.add(package)
        copy_with_links(path, root, copies)
    rows = [describe(package, root) for package in sorted(packages)]
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": "throng-image",
        "documentNamespace": "https://throng.invalid/spdx/image",
        "creationInfo": {"creators": ["Tool: docker/runtime_root.py"], "created": "2026-01-01T00:00:00Z"},
        "packages": rows,
    }
    target = root / "usr/share/doc/throng-image/packages.spdx.json"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print(f"{len(wanted)} files of {len(rows)} packages")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
