#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the benchmarks that stand beside the tables of Wang and Manocha, and prints the results as Markdown.

What is compared with other libraries is left out where the programs of bench/others were not built. All times of a line are of one
run, one program after the other.

Example: paper_tables.py build/tables/bin > bench/RESULTS.md
"""

import argparse
import json
import math
import os
import platform
import re
import subprocess
import sys
import tempfile
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
# Of the paper: exact over floating time (table 1), seconds and triangles of a repair (table 4), on the machine of 2011.
PAPER_RATIO = {"spider": 4.9, "turtle": 5.4, "head": 7.4, "oil rig": 5.5, "ship": 6.6, "harp": 4.9, "bone-truss": 8.2,
               "pig-helix": 7.7, "blob": 5.7}
PAPER_REPAIR = {"ship": (15812, 4.91, 45984), "harp": (10652, 4.67, 45853), "spider": (4999, 4.68, 36317),
                "turtle": (5499, 3.57, 29386), "head": (16532, 6.27, 62521), "cow": (5804, 2.86, 25988),
                "oil rig": (45326, 7.90, 83672)}
COUNTERPART = {"spider": "Spider", "turtle": "Turtle", "head": "David-egea", "oil rig": "Oil-rig", "ship": "Dutch-ship",
               "harp": "Harp", "bone-truss": "Femur ∩ Truss", "pig-helix": "Pig \\ Helix", "blob": "Bunny", "cow": "Cow"}


class Programs:
    def __init__(self, folder, work, timeout):
        self.folder, self.work, self.timeout = folder, work, timeout

    def there(self, name):
        return os.access(os.path.join(self.folder, name), os.X_OK)

    def file(self, name):
        return os.path.join(self.work, name)

    def run(self, name, *arguments, timeout=None):
        """Seconds, peak bytes, exit code (None: out of time) and standard output."""
        out = self.file("stdout")
        with open(out, "w", encoding="utf-8") as file:
            start = time.monotonic()
            child = subprocess.Popen([os.path.join(self.folder, name), *map(str, arguments)], stdout=file,
                                     stderr=subprocess.DEVNULL)
            while True:
                pid, status, usage = os.wait4(child.pid, os.WNOHANG)
                seconds = time.monotonic() - start
                if pid:
                    child.returncode = os.waitstatus_to_exitcode(status)
                    break
                if seconds > (timeout or self.timeout):
                    child.kill()
                    _, _, usage = os.wait4(child.pid, 0)
                    child.returncode = None
                    break
                time.sleep(0.002)
        with open(out, encoding="utf-8") as file:
            return seconds, 1024 * usage.ru_maxrss, child.returncode, file.read()

    def ours(self, name, *arguments):
        """Seconds, peak bytes and the report; the report is None where the program did not end with 0 or 1."""
        report = self.file("report.json")
        whole = ["--always"] if name in ("meshrepair", "bspbool") else []  # sound models, too; by trees
        seconds, peak, code, _ = self.run(name, *arguments, *whole, "--report", report, "--quiet")
        if code not in (0, 1):
            return seconds, peak, None
        with open(report, encoding="utf-8") as file:
            read = json.load(file)
        # Measured for the report alone.
        return seconds - stage_seconds(read, "distance"), peak, read


def table(columns, rows):
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print(flush=True)


def short(number, digits=3):
    if number is None:
        return "-"
    text = f"{number:.{digits}g}"
    return text if "e" not in text else re.sub(r"e([+-])0*", r"e\1", text)


def seconds_of(number):
    return f"{number:.3f}" if number < 1 else f"{number:.2f}"


def thousands(number):
    return f"{number:,}"


def megabytes(number):
    return f"{number / 1e6:,.0f}"


def times(a, b):
    return f"{a / b:.2f}" if b > 0 else "-"


def machine():
    name = platform.machine()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                name = line.split(":", 1)[1].strip()
                break
    with open("/proc/meminfo", encoding="utf-8") as file:
        memory = int(file.readline().split()[1]) / 1024**2
    return f"{name}, {os.cpu_count()} cores, {memory:.0f} GiB"


def commit():
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False).stdout.strip()
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!bench/RESULTS.md")
    return git("rev-parse", "--short", "HEAD") + (" and changes" if changed else "")


def named(model):
    return f"{model} ({COUNTERPART[model]})"


def engines(programs):
    print("## Exact and floating predicates (tables 1 and 2)\n")
    if not programs.there("engines_table"):
        print("Left out: it needs GMP.\n")
        return
    print("From a labelled tree to its cells (clipping), and on to the merged mesh. `GMP` is the paper's exact variant (a determinant "
          "in\ndoubles, and GMP below 1e-10), `exact` this project's default, `float` `--predicates float`. Flooding is the paper's "
          "region\nflooding, here a fallback; with exact answers it never runs. Predicates: the seconds of all questions on which side "
          "a point lies.\n")
    speed, memory = [], []
    for model in PAPER_RATIO:
        _, _, code, text = programs.run("engines_table", model)
        if code != 0:
            speed.append([named(model), "failed"] + ["-"] * 13)
            continue
        row = json.loads(text)
        gmp, exact, floating = row["gmp"], row["exact"], row["float"]
        speed.append([named(model), f"{thousands(row['nodes'])} ({row['depth']})"] +
                     [seconds_of(engine["clip_seconds"]) for engine in (gmp, exact, floating)] +
                     [times(gmp["clip_seconds"], floating["clip_seconds"]), str(PAPER_RATIO[model]),
                      times(exact["clip_seconds"], floating["clip_seconds"])] +
                     [seconds_of(engine["total_seconds"]) for engine in (gmp, exact, floating)] +
                     [f"{floating['flood_seconds']:.4f}"] +
                     [f"{engine['predicate_seconds']:.4f}" for engine in (gmp, exact, floating)])
        memory.append([named(model), thousands(row["nodes"])] +
                      [megabytes(engine["peak_bytes"]) for engine in (gmp, exact, floating)])
    table(["model (the paper's)", "nodes (depth)", "clipping: GMP, s", "exact, s", "float, s", "GMP : float", "in the paper",
           "exact : float", "to the mesh: GMP, s", "exact, s", "float, s", "flooding, s", "predicates: GMP, s", "exact, s", "float, s"],
          speed)
    print("Peak memory beyond the tree itself:\n")
    table(["model (the paper's)", "nodes", "GMP, MB", "exact, MB", "float, MB"], memory)


def stage_seconds(report, *names):
    return sum(stage["seconds"] for stage in report["stages"] if stage["name"] in names)


def booleans(programs, models):
    print("## Boolean operations (table 3)\n")
    print("Whole programs, files read and written. Trees: of both solids on the common grid, labelled. Extraction: cells, cover, "
          "extraction,\ncertification. CGAL's corefinement rounds its points and certifies nothing; its Nef polyhedra are exact.\n")
    cases = [("bone.off", "truss.off", "intersection"), ("pig.off", "helix.off", "difference"),
             ("sphere_a.off", "sphere_b.off", "union")]
    rows = []
    for first, second, operation in cases:
        a, b = os.path.join(models, first), os.path.join(models, second)
        seconds, _, report = programs.ours("bspbool", a, b, "--op", operation, "-o", programs.file("ours.off"))
        by_programs = float(programs.run("merge_by_programs", a, b, operation)[3])
        row = [f"{first[:-4]}, {second[:-4]}: {operation}", thousands(report["result"]["triangles"]),
               seconds_of(stage_seconds(report, "operands")), seconds_of(stage_seconds(report, "merge")),
               seconds_of(by_programs),
               seconds_of(stage_seconds(report, "cells", "cover", "extract", "certify", "check")), seconds_of(seconds)]
        for method in ([], ["nef"]):
            row += cgal(programs, a, b, operation, method, seconds, report["result"]["volume"])
        rows.append(row)
    table(["operation", "triangles", "trees, s", "merge, s", "merge by linear programs, s", "extraction, s", "all, s",
           "corefinement, s", "ours : that", "volume apart", "Nef, s", "ours : that", "volume apart"], rows)


def cgal(programs, a, b, operation, method, ours, volume):
    if not programs.there("cgal_booleans"):
        return ["not built", "-", "-"]
    seconds, _, code, text = programs.run("cgal_booleans", a, b, operation, programs.file("cgal.off"), *method)
    if code is None:
        return [f"over {programs.timeout:.0f}", "-", "-"]
    if code != 0:
        return ["failed", "-", "-"]
    return [seconds_of(seconds), times(ours, seconds), short(abs(json.loads(text)["volume"] - volume) / abs(volume), 2)]


def repairs(programs, models, meshes):
    print("## Repair (table 4)\n")
    print("`meshrepair`, whole program. Before merging: the triangles that the facets of the cells would give, as the paper counts them.\n")
    files = [(model, os.path.join(models, model.replace(" ", "_") + ".off")) for model in PAPER_REPAIR]
    files += [(os.path.basename(path), path) for path in meshes]
    rows = []
    for name, path in files:
        seconds, peak, report = programs.ours("meshrepair", path, programs.file("out.off"))
        paper = PAPER_REPAIR.get(name)
        title = named(name) if paper else name
        if report is None:
            rows.append([title] + ["-"] * 8)
            continue
        given = report["clean"]["triangles_in"]
        result = report["result"]["triangles"]
        rows.append([title, thousands(given), thousands(report["extract"]["unmerged_triangles"]), thousands(result),
                     times(result, given), seconds_of(seconds), megabytes(peak),
                     f"{thousands(paper[2])} of {thousands(paper[0])}" if paper else "-", times(paper[2], paper[0]) if paper else "-"])
    table(["model (the paper's)", "input", "before merging", "result", "result : input", "time, s", "MB", "in the paper",
           "result : input"], rows)


def thin_parts(programs, models, voxels):
    print("## Thin parts (fig. 3)\n")
    print("A ship's ropes and a harp's strings, a thousandth as thick as the model is large: how many are inside the result along "
          "their\nwhole length? Distance: of the result from the input, relative to the diagonal. OpenVDB: mesh to level set to mesh, with "
          "so many\nvoxels along the longest side.\n")
    rows = []
    for model in ("ship", "harp"):
        out = programs.file("out.off")
        seconds, peak, report = programs.ours("meshrepair", os.path.join(models, model + ".off"), out)
        _, _, _, held = programs.run("strands_held", model, out)
        distance = report["distance"]["output_to_input"]["relative"]["hausdorff"]
        total = None
        others = []
        for count in voxels if programs.there("openvdb_remesh") else []:
            spent, other_peak, code, text = programs.run("openvdb_remesh", model, count)
            if code != 0:
                others.append([model, f"OpenVDB {count}", f"over {programs.timeout:.0f}" if code is None else "failed"] + ["-"] * 5)
                continue
            said = json.loads(text)
            total = said["strands"]
            others.append([model, f"OpenVDB {count}", seconds_of(said["seconds"]), times(said["seconds"], seconds),
                           megabytes(other_peak), thousands(said["triangles"]), f"{said['strands_held']} of {total}",
                           short(said["distance"], 2)])
        rows.append([model, "meshrepair", seconds_of(seconds), "1.00", megabytes(peak), thousands(report["result"]["triangles"]),
                     held.strip() + (f" of {total}" if total else ""), short(distance, 2)])
        rows += others
    table(["model", "method", "time, s", "to ours", "MB", "triangles", "thin parts whole", "distance"], rows)


def accuracy(programs, models, meshes):
    print("## How far the floating predicates lead astray (section 5)\n")
    print("`meshrepair --predicates float` beside the exact result: two-sided distance relative to the diagonal, as `meshdist` reports "
          "it, and\nwhat the clipper had to fall back on.\n")
    files = [(named(model), os.path.join(models, model.replace(" ", "_") + ".off")) for model in PAPER_REPAIR]
    files += [(os.path.basename(path), path) for path in meshes]
    rows = []
    for title, path in files:
        exact, floating = programs.file("exact.off"), programs.file("float.off")
        _, _, report = programs.ours("meshrepair", path, exact)
        _, _, other = programs.ours("meshrepair", path, floating, "--predicates", "float")
        if report is None or other is None:
            rows.append([title] + ["-"] * 6)
            continue
        _, _, _, text = programs.run("meshdist", exact, floating, "--json", "--quiet")
        distance = json.loads(text)["distance"]
        mean = max(distance[way]["mean"] for way in ("a_to_b", "b_to_a"))
        volume = abs(other["result"]["volume"] - report["result"]["volume"]) / abs(report["result"]["volume"])
        clip = other["cells"]["fallbacks"]
        rows.append([title, short(mean / distance["diagonal"], 2), short(distance["hausdorff"] / distance["diagonal"], 2),
                     short(volume, 2)] + [thousands(clip[key]) for key in ("several_groups", "region_floods", "forced_cuts")] +
                    ["no" if "FAIL" in other["certificate"].values() else "yes"])
    table(["model", "mean", "Hausdorff", "volume", "facets cut several times", "floods", "forced cuts", "certified"], rows)


def point_clouds(programs):
    print("## Point clouds (fig. 16)\n")
    print("Samples of known solids, 25,000 points each, as in the paper; its Armadillo, Buddha and Filigree gave 106,000 to 108,000 "
          "triangles,\n231,000 to 246,000 after 24 to 31 s of repair. Here the triangulation leaves few triangles that cross. Distances "
          "are from and to\nthe true surface, in spacings of the points.\n")
    folder = programs.file("clouds")
    os.makedirs(folder, exist_ok=True)
    print(programs.run("points_table", "--sizes", 25000, "--clouds", folder, timeout=10 * programs.timeout)[3])
    print("Beside CGAL, on the random clouds with noise: advancing front, and Poisson with normals estimated and oriented by CGAL. "
          "Distance:\ntwo-sided, relative to the diagonal of the true surface. Valid: closed, manifold and without self-intersections, by "
          "`meshcheck`.\n")
    rows = []
    for cloud in sorted(os.listdir(folder)):
        if not cloud.endswith("_random__noise_0_1_25000.xyz"):
            continue
        solid = cloud[:-len("_random__noise_0_1_25000.xyz")]
        path, truth = os.path.join(folder, cloud), os.path.join(folder, solid + ".off")
        for method in ("meshrepair", "front", "poisson"):
            rows.append(one_cloud(programs, solid.replace("_", " ").replace("  ", " "), path, truth, method))
    table(["solid", "method", "time, s", "triangles", "closed", "valid", "distance"], rows)


def one_cloud(programs, solid, path, truth, method):
    out = programs.file("cloud.off")
    title = {"meshrepair": "meshrepair", "front": "CGAL advancing front", "poisson": "CGAL Poisson"}[method]
    if method == "meshrepair":
        seconds, _, report = programs.ours("meshrepair", path, out)
        done = report is not None
        triangles = report["result"]["triangles"] if done else 0
    else:
        if not programs.there("cgal_points"):
            return [solid, title, "not built"] + ["-"] * 4
        seconds, _, code, text = programs.run("cgal_points", path, out, method)
        done = code == 0
        triangles = json.loads(text)["triangles"] if done else 0
    if not done:
        return [solid, title, "no result"] + ["-"] * 4
    _, _, _, text = programs.run("meshcheck", out, "--json", "--quiet")
    check = json.loads(text)["check"]
    _, _, _, text = programs.run("meshdist", truth, out, "--json", "--quiet")
    distance = json.loads(text)["distance"]
    return [solid, title, seconds_of(seconds), thousands(triangles), "yes" if check["closed"] else "no",
            "yes" if check["valid_solid"] else "no", short(distance["hausdorff"] / distance["diagonal"], 2)]


def point_accuracy(programs):
    """The largest distances over clouds of several sizes, from the rows that points_table prints."""
    print("## How well solids are found again from points\n")
    print("Samples of known solids, 2,000, 20,000 and 200,000 points each, with `points_table`. The largest Hausdorff distance of the three "
          "from\nthe true surface, either way, in spacings (the square root of area by points). Noise is normally distributed, a tenth of the "
          "spacing\nin each coordinate. Certified: all results, with the right number of parts and handles.\n")
    _, _, _, text = programs.run("points_table", timeout=100 * programs.timeout)
    accuracy_table(text)


def million_points(programs):
    print("## A million points\n")
    print("`points_table --sizes 1000000 --only torus`: seconds of processor time, and the most memory of the whole run.\n")
    _, peak, _, text = programs.run("points_table", "--sizes", 1000000, "--only", "torus", timeout=100 * programs.timeout)
    million_table(text, megabytes(peak))


def million_table(text, peak):
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in text.splitlines()[2:]]
    table(["cloud", "triangles of three votes", "result", "triangulation, s", "repair, s"],
          [[row[1], thousands(int(row[3].split(" / ")[0])), row[12], row[13], row[14]] for row in rows])
    print(f"Peak memory: {peak} MB.")


def accuracy_table(text):
    largest, certified = {}, {}
    for line in text.splitlines()[2:]:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        solid, cloud, distances, verdict = cells[0], cells[1], cells[11], cells[12]
        farthest = max(map(float, distances.split(" / "))) if " / " in distances else math.inf
        row = largest.setdefault(solid, {})
        row[cloud] = max(row.get(cloud, 0), farthest)
        certified[solid] = certified.get(solid, True) and verdict == "certified"
    clouds = list(next(iter(largest.values())))
    table(["solid", *clouds, "certified"],
          [[solid, *(f"{row[cloud]:.2f}" for cloud in clouds), "yes" if certified[solid] else "no"] for solid, row in largest.items()])


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="folder of the programs")
    parser.add_argument("meshes", nargs="*", help="meshes to be repaired, too")
    parser.add_argument("--timeout", type=float, default=30, metavar="SECONDS", help="of each program [%(default)s]")
    parser.add_argument("--voxels", type=int, nargs="+", default=[256, 512, 1024, 2048], metavar="N",
                        help="across the models of fig. 3, for OpenVDB")
    return parser.parse_args()


def main():
    args = arguments()
    with tempfile.TemporaryDirectory() as work:
        programs = Programs(args.bin, work, args.timeout)
        models = programs.file("models")
        if programs.run("make_models", models)[2] != 0:
            sys.exit("the models could not be written")
        print("# Beside the paper's tables\n")
        print("Wang and Manocha, Efficient Boundary Extraction of BSP Solids Based on Clipping Operations (2013), measured again. Their "
              "models are\nnot public; these are made by code, of the same kinds and sizes. Written by `scripts/paper_tables.sh`.\n")
        print(f"Machine: {machine()}. Commit: {commit()}.\n")
        engines(programs)
        booleans(programs, models)
        repairs(programs, models, args.meshes)
        thin_parts(programs, models, args.voxels)
        accuracy(programs, models, args.meshes)
        point_clouds(programs)
        point_accuracy(programs)
        million_points(programs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
