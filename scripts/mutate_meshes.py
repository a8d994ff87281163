#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs meshrepair on damaged copies of meshes and looks whether it ends as it should.

Each copy is cut, has bits flipped, or is spliced with itself or another mesh; of 3MF packages also one of the
parts in them. It has to end with a
documented exit code and one line, within the time, leave an output if and only if it says so, and what it
calls certified has to be a valid solid to meshcheck. Build it with the sanitizers to see more:

    cmake --preset asan-ubsan && cmake --build build/asan-ubsan --target app_meshrepair
    scripts/mutate_meshes.py meshes --count 10000
"""

import argparse
import collections
import concurrent.futures
import io
import os
import random
import subprocess
import sys
import tempfile
import time
import zipfile
import zlib

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
PACKAGE = ".3mf"
SCENES = (".glb", ".gltf", PACKAGE)
EXTENSIONS = (".stl", ".obj", ".off", ".ply", *SCENES)
CERTIFIED, WRITTEN, SANITIZER = 0, (0, 1), 99
DOCUMENTED = (0, 1, 3, 4, 5, 6)
OPTIONS = ([], [], [], ["--inside", "solidity"], ["--inside", "winding"], ["--inside", "parity"],
           ["--holes", "extend"], ["--holes", "none"], ["--touching", "join"], ["--cavities", "fill"],
           ["--drop", "all"], ["--units", "mm"])
EACH_MESH = ["--scene", "each"]  # only where the output says what stands where
# What a sanitizer ends with is to differ from all exit codes of ours.
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS=f"exitcode={SANITIZER}:detect_leaks=1",
                   UBSAN_OPTIONS=f"exitcode={SANITIZER}:print_stacktrace=1:halt_on_error=1")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="with the meshes, and sub-folders")
    parser.add_argument("--count", type=int, default=1000, help="of damaged copies (%(default)s)")
    parser.add_argument("--first", type=int, default=0, help="number of the first copy (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of all choices (%(default)s)")
    parser.add_argument("--largest", type=int, default=400_000, metavar="BYTES",
                        help="leave out larger meshes (%(default)s)")
    parser.add_argument("--timeout", type=float, default=60, metavar="SECONDS",
                        help="a longer run is a finding (%(default)s)")
    parser.add_argument("--time-limit", type=float, default=45, metavar="SECONDS",
                        help="of meshrepair, to whose exit code 4 it leads (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at once (%(default)s)")
    parser.add_argument("--meshrepair", default=f"{ROOT}/build/asan-ubsan/bin/meshrepair")
    parser.add_argument("--meshcheck", default=f"{ROOT}/build/release/bin/meshcheck")
    parser.add_argument("--findings", default=f"{ROOT}/build/mutations",
                        help="folder for the copies that were findings (%(default)s)")
    return parser.parse_args()


def meshes_in(folder, largest):
    meshes = []
    for place, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            path = os.path.join(place, name)
            if name.lower().endswith(EXTENSIONS) and 0 < os.path.getsize(path) <= largest:
                meshes.append(path)
    return meshes


def cut(data, _, chance):
    return data[:chance.randrange(len(data))]


def flip_bits(data, _, chance):
    damaged = bytearray(data)
    # Half of the time near the beginning, where headers are.
    end = min(len(damaged), chance.choice((200, len(damaged))))
    for _ in range(int(2 ** chance.uniform(0, 8))):
        damaged[chance.randrange(end)] ^= 1 << chance.randrange(8)
    return bytes(damaged)


def splice(data, other, chance):
    start, length = chance.randrange(len(other)), int(2 ** chance.uniform(0, 16))
    at, gone = chance.randrange(len(data)), chance.choice((0, length))
    return data[:at] + other[start:start + length] + data[at + gone:]


def parts_of(package):
    """Names and bytes; none if it is no archive."""
    try:
        with zipfile.ZipFile(io.BytesIO(package)) as archive:
            return {name: archive.read(name) for name in archive.namelist()}
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, zlib.error):
        return {}


def inside(kind):
    """The same damage in a part of a package: checksums and sizes are right."""
    def damage(data, other, chance):
        parts = parts_of(data)
        names = sorted(name for name, text in parts.items() if text)
        if not names:
            return kind(data, other, chance)
        models = [name for name in names if name.endswith(".model")]
        name = chance.choice(models if models and chance.random() < 0.7 else names)
        texts = [text for text in parts_of(other).values() if text] or [parts[name]]
        parts[name] = kind(parts[name], chance.choice(texts), chance)
        package = io.BytesIO()
        with zipfile.ZipFile(package, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, text in parts.items():
                archive.writestr(name, text)
        return package.getvalue()
    damage.__name__ = "inside"
    return damage


class Copy:
    def __init__(self, number, meshes, seed):
        chance = random.Random(f"{seed}:{number}")
        self.number = number
        self.mesh = chance.choice(meshes)
        self.kind = chance.choice((cut, flip_bits, splice))
        with open(self.mesh, "rb") as file:
            data = file.read()
        other = data
        if chance.random() < 0.5:
            with open(chance.choice(meshes), "rb") as file:
                other = file.read()
        self.extension = os.path.splitext(self.mesh)[1].lower()
        if self.extension == PACKAGE and chance.random() < 0.8:
            self.kind = inside(self.kind)
        self.data = self.kind(data, other, chance)
        self.output = "out" + chance.choice(EXTENSIONS)
        self.options = chance.choice(OPTIONS)
        if self.output.endswith(SCENES) and chance.random() < 0.3:
            self.options = [*self.options, *EACH_MESH]


def files_too_many(output, code):
    """What lies beside the input and what is written; a library and pictures beside an OBJ file are right."""
    folder, name = os.path.split(output)
    others = [other for other in os.listdir(folder) if other != name and not other.startswith("in.")]
    is_library = code in WRITTEN and name.endswith(".obj")
    return [other for other in others if not (is_library and other.startswith("out"))]


def trouble_of(code, errors, output, options, arguments):
    if code == SANITIZER or b"Sanitizer" in errors or b"runtime error" in errors:
        return "sanitizer: " + errors.decode("utf-8", "replace")[:3000]
    if code not in DOCUMENTED:
        return f"exit code {code}: " + errors.decode("utf-8", "replace")[-300:]
    if os.path.exists(output) != (code in WRITTEN):
        return f"exit code {code}, but the output is " + ("there" if code not in WRITTEN else "missing")
    lines = [line for line in errors.splitlines() if line.startswith(b"meshrepair: ") and b": warning: " not in line]
    if len(lines) != (0 if code == CERTIFIED else 1):
        return f"exit code {code} with {len(lines)} lines"
    if files_too_many(output, code):
        return f"exit code {code}, and other files: {files_too_many(output, code)}"
    if code != CERTIFIED:
        return ""
    each = EACH_MESH if "each" in options else []
    check = subprocess.run([arguments.meshcheck, output, *each, "--time-limit", str(arguments.timeout)],
                           capture_output=True, check=False)
    return "" if check.returncode == 0 else "certified, but: " + check.stdout.decode()[-300:]


def run(number, meshes, arguments):
    """The exit code, the seconds, and what is wrong, if anything."""
    copy = Copy(number, meshes, arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        source, output = (os.path.join(folder, name) for name in ("in" + copy.extension, copy.output))
        with open(source, "wb") as file:
            file.write(copy.data)
        start = time.monotonic()
        try:
            result = subprocess.run(
                [arguments.meshrepair, source, output, "--quiet", "--threads", "1",
                 "--time-limit", str(arguments.time_limit), *copy.options],
                capture_output=True, check=False, timeout=arguments.timeout, env=ENVIRONMENT)
            code = result.returncode
            trouble = trouble_of(code, result.stderr, output, copy.options, arguments)
        except subprocess.TimeoutExpired:
            code, trouble = "timeout", f"ran for more than {arguments.timeout:g} s"
        seconds = time.monotonic() - start
    if trouble:
        os.makedirs(arguments.findings, exist_ok=True)
        path = os.path.join(arguments.findings, f"{arguments.seed}_{number}{copy.extension}")
        with open(path, "wb") as file:
            file.write(copy.data)
        options = " ".join([copy.output, *copy.options])
        trouble = f"{path} ({copy.kind.__name__}, {os.path.basename(copy.mesh)}; {options}): {trouble}"
    return copy.kind.__name__, code, seconds, trouble


def main():
    arguments = parse_arguments()
    meshes = meshes_in(arguments.folder, arguments.largest)
    if not meshes:
        sys.exit(f"mutate_meshes.py: no meshes in {arguments.folder}")
    tally, slowest, troubles = collections.Counter(), (0, None), 0
    numbers = range(arguments.first, arguments.first + arguments.count)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = pool.map(lambda number: run(number, meshes, arguments), numbers)
        for number, (kind, code, seconds, trouble) in zip(numbers, results):
            tally[kind, str(code)] += 1
            slowest = max(slowest, (seconds, number))
            if trouble:
                troubles += 1
                print(trouble, flush=True)
            if sys.stderr.isatty():
                print(f"\r{number + 1 - arguments.first}/{arguments.count}", end="", file=sys.stderr)
    print(f"{arguments.count} damaged copies of {len(meshes)} meshes, {troubles} findings, "
          f"the slowest run {slowest[0]:.1f} s (copy {slowest[1]})")
    codes = sorted({code for _, code in tally})
    kinds = sorted({kind for kind, _ in tally})
    print(f"{'exit code':<10}" + "".join(f"{kind:>10}" for kind in kinds) + f"{'all':>10}")
    for code in codes:
        row = [tally[kind, code] for kind in kinds]
        print(f"{code:<10}" + "".join(f"{count:>10}" for count in row) + f"{sum(row):>10}")
    return 1 if troubles else 0


if __name__ == "__main__":
    sys.exit(main())
