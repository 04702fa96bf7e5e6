#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tread reference: against CONTACT, for every kind of scene, in the files of a run, and bad input."""

import csv
import json
import math
import os
import resource
import sys
import tempfile

from tread.runs import ROOT, arguments_of, execute
from tread_runner import Check, explained_keys, rows_of, run, script, unexplained_keys

program = sys.argv[1]
check = Check()
SCENE = "smooth-rolling.prm"
CONTACT = os.path.join(ROOT, "contrib", "contact-data")


def printed(name, *arguments):
    """script() with what it wrote printed."""
    result = script(name, *arguments)
    print(result.stdout, result.stderr)
    return result


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    numbers = iter(range(1000))

    def reference_only(*settings, scene=SCENE, ranks=1, output=None):
        return run(program, scene, output or path(str(next(numbers))), settings, ranks, command="reference")

    # run() asks of every summary of these tests that its keys are explained: of this one only some are.
    check.that("keys without a meaning are found",
               unexplained_keys({"wheel_3_creepage": 0., "wheel_3_made_up": 0., "cell_12_x_m": 0., "creepage_half_space_uncertainty": 0., "made_up_Pa": 0.,
                                 "patches": [{"x_m": 0., "made_up_m": 0.}], "reference": {"creepage": {"half-space": {"value": 0., "made_up": 0.}}}},
                                explained_keys(program)) == ["made_up_Pa", "patches/1/made_up_m", "reference/max_pressure_Pa/Hertz/made_up", "wheel_2_made_up"])

    # Hertz's radius is that over the patch that comes out: a crown of 200 mm within 2 mm of the middle, 50 mm beyond.
    with open(path("two-radii.txt"), "w", encoding="utf-8") as stream:
        for k in range(-150, 151):
            y, near = 0.1 * k, min(abs(0.1 * k), 2.)
            slope = near / math.sqrt(200.**2 - near**2)
            beyond = abs(y) - near + 50. * slope / math.sqrt(1. + slope**2)  # on the circle that goes on with the same slope
            z = math.sqrt(200.**2 - near**2) - 200. + math.sqrt(50.**2 - beyond**2) - 50. / math.sqrt(1. + slope**2)
            stream.write(f"{y:.3f} {z:.7f}\n")
    small = ["Vehicle/Wheel load (kN)=0.5", "Wheel/Mass (kg)=20", "Mesh/Finest cell (mm)=0.1"]
    crown = reference_only("Rail/Shape=block", "Rail/Crown radius (mm)=200", *small)
    both = reference_only(f"Rail/Measured head={path('two-radii.txt')}", *small)
    check.that("a patch within the inner radius", 1e3 * crown["reference"]["semi_axis_y_m"]["Hertz"]["value"] < 1.2)
    for key in ("max_pressure_Pa", "semi_axis_x_m", "semi_axis_y_m"):
        check.relative(f"a head of two radii: Hertz has that of the patch, {key}", both["reference"][key]["Hertz"]["value"],
                       crown["reference"][key]["Hertz"]["value"], 0.005)

    # Values that are hardly meant, and those that another one makes void, are told here as before a run.
    heavy = reference_only("Vehicle/Axle load (t)=95", "Contact/Kinetic friction coefficient=0.1")
    check.that(f"an axle load in kN, and a coefficient that Coulomb's law has not: {heavy['warnings']}", len(heavy["warnings"]) == 2
               and "'Contact/Kinetic friction coefficient' has no effect" in heavy["warnings"][0] and "'Vehicle/Axle load (t)' 95" in heavy["warnings"][1])
    displaced = reference_only("Wheelset/Flange back (mm)=-66", scene="curves/flange-root.prm")
    check.that(f"a flange whose back lies elsewhere: {displaced['warnings']}", any("stands 4 mm off" in warning for warning in displaced["warnings"]))

    # Against CONTACT, whose values are of first order: extrapolated from its elements of 0.2 and 0.1 mm. What the edge of
    # the patch on those two grids leaves in them is 0.1 or 0.2 %, more in what sits at that edge.
    with open(os.path.join(CONTACT, "contact_summary.csv"), encoding="utf-8") as stream:
        table = list(csv.DictReader(stream))
    with open(os.path.join(ROOT, "tests", "data", "contact_summary.csv"), encoding="utf-8") as stream:
        convergence = {(float(r["mu"]), float(r["dx_mm"])): r
                       for r in csv.DictReader(line for line in stream if not line.startswith("#"))}
    for row in table:
        fine, coarse = (convergence[float(row["traction_coefficient"]), size] for size in (0.1, 0.2))
        extrapolated = lambda name: 2 * abs(float(fine[name])) - abs(float(coarse[name]))
        mu = f"{float(row['traction_coefficient']):.2f}"
        spent = resource.getrusage(resource.RUSAGE_CHILDREN)
        answer = reference_only(scene=f"verification/half-space-0.63-mu{mu}.prm", output=path(mu))
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = used.ru_utime - spent.ru_utime + used.ru_stime - spent.ru_stime
        name = f"traction coefficient {mu}"
        check.relative(f"{name}: normal force, N", answer["normal_force_N"], float(row["normal_force_N"]), 1e-6)
        check.relative(f"{name}: traction coefficient", answer["traction_coefficient"], float(mu), 1e-6)
        check.relative(f"{name}: maximum pressure, MPa", 1e-6 * answer["max_pressure_Pa"], float(row["max_pressure_MPa"]), 0.003)
        check.relative(f"{name}: patch area, mm2", 1e6 * answer["patch_area_m2"], extrapolated("area_mm2"), 0.003)
        check.relative(f"{name}: creepage, 1e-3", 1e3 * answer["creepage"], 1e3 * extrapolated("creepage"), 0.002)
        check.absolute(f"{name}: adhesion share, %", 100 * answer["adhesion_share"], 100 * extrapolated("adhesion_share"), 0.08)
        check.relative(f"{name}: maximum shear stress, MPa", 1e-6 * answer["max_shear_Pa"], extrapolated("max_shear_MPa"), 0.006)
        check.relative(f"{name}: maximum micro-slip, m/s", answer["max_slip_m_per_s"], extrapolated("max_slip_m_per_s"), 0.01)
        check.relative(f"{name}: frictional power, W", answer["frictional_power_W"],
                       float(mu) * 127.1e3 * extrapolated("creepage") * 140 / 3.6, 0.002)
        for key in ("max_pressure_Pa", "creepage", "adhesion_share", "max_shear_Pa", "max_slip_m_per_s", "frictional_power_W"):
            check.that(f"{name}: {key}: uncertainty below 1 %",
                       0. <= answer[key + "_half_space_uncertainty"] < 0.01 * abs(answer[key]))
        # asked for: a second. Processor time, for the machine may be busy, which can still double it.
        check.below(f"{name}: processor time, s", seconds, 2.)

        measures = path("measures.json")
        compared = printed("plot/compare-contact.py", path(mu), os.path.join(CONTACT, row["file"]), "--json", measures)
        check.that(f"{name}: compare-contact.py reads it", compared.returncode == 0)
        with open(measures, encoding="utf-8") as stream:
            fields = json.load(stream)
        # CONTACT's slip is that of half an element ahead.
        check.below(f"{name}: pressure, RMS over the maximum", fields["pressure_rms_over_max"], 0.0028)
        check.below(f"{name}: shear stress, RMS over the maximum", fields["shear_rms_over_max"], 0.0088)
        check.below(f"{name}: micro-slip, RMS over the maximum", fields["micro_slip_rms_over_max"], 0.017)

    # Below the surface: CONTACT's depth lines of the same case, in both bodies under the patch centre. Stresses are those
    # of elements of 0.31 mm, so depths from there on (a twentieth of the smaller semi-axis).
    with open(os.path.join(ROOT, "tests", "data", "contact_subsurface.csv"), encoding="utf-8") as stream:
        contact = [row for row in csv.DictReader(line for line in stream if not line.startswith("#"))
                   if row["case"] == "mu030" and row["line"] == "x0" and 0.29 < float(row["depth_mm"]) < 17.]
    with open(os.path.join(path("0.30"), "subsurface.csv"), encoding="utf-8") as stream:
        own = [row for row in csv.DictReader(stream) if row["line"] == "centre"]
    for body in ("wheel", "rail"):
        line = [(float(row["depth_mm"]), float(row["von_mises_MPa"])) for row in own if row["body"] == body]
        worst = 0.
        reference = [(float(row["depth_mm"]), float(row["von_mises_MPa"])) for row in contact if row["body"] == body]
        for depth, value in reference:
            upper = next(i for i, (z, _) in enumerate(line) if z >= depth)
            (z0, s0), (z1, s1) = line[upper - 1], line[upper]
            worst = max(worst, abs(s0 + (s1 - s0) * (depth - z0) / (z1 - z0) - value) / value)
        check.that(f"{body}: a line of depths to compare with", len(reference) > 20)
        check.below(f"{body}: von Mises under the centre, largest relative difference", worst, 0.01)

    # The files of a run, and nothing else touched.
    files = sorted(os.listdir(path("0.30")))
    check.that("the files of a run", files == ["parameters.prm", "patch.csv", "subsurface.csv", "summary.json",
                                               "surface-0000.vtu", "surface.pvd"])
    check.that("plot-run.py draws it", printed("plot/plot-run.py", path("0.30")).returncode == 0 and
               sorted(os.listdir(os.path.join(path("0.30"), "pictures"))) == ["axis.png", "depth.png", "map.png", "vectors.png"])
    paraview = printed("paraview/tread.py", path("0.30"))
    check.that("tread.py reads it", paraview.returncode == 0 and "pressure_MPa" in paraview.stdout)
    results = path("results")
    os.mkdir(results)
    with open(os.path.join(results, "summary.json"), "w", encoding="utf-8") as stream:
        stream.write("kept")
    execute(arguments_of(SCENE, [f"Output/Directory={results}"], command="reference"), program=program, check=True)
    with open(os.path.join(results, "summary.json"), encoding="utf-8") as stream:
        check.that("without --output a run's results are kept", stream.read() == "kept")
    check.that("without --output it writes beside them", os.path.exists(results + "-reference/summary.json"))

    # From a start without tractions: the way to steady rolling, at the creepage of the scene.
    transient = reference_only("Motion/Rolled distance (mm)=60", scene="verification/transient-low-strain.prm", output=path("transient"))
    way = rows_of(path("transient"), "transient.csv")
    check.relative("transient: it ends at the distance rolled, mm", way[-1]["rolled_mm"], 60., 1e-6)
    check.below("transient: traction coefficient at the start", way[0]["traction_coefficient"], 1e-12)
    check.relative("transient: traction coefficient at the end", way[-1]["traction_coefficient"], transient["traction_coefficient"], 0.003)
    check.relative("transient: creepage", way[-1]["creepage"], 6.65e-4, 1e-9)
    check.that("transient: the traction rises all the way",
               all(after["traction_coefficient"] > before["traction_coefficient"] for before, after in zip(way, way[1:])))

    # A folder that held a run: what it wrote is removed, its history is not of this answer.
    again = path("again")
    os.mkdir(again)
    open(os.path.join(again, "history.csv"), "w", encoding="utf-8").close()
    two = reference_only(output=again, ranks=2)
    check.that("no history of an earlier run is left", not os.path.exists(os.path.join(again, "history.csv")))

    # Every kind of scene.
    base = reference_only()
    for key in ("creepage", "max_pressure_Pa", "wheel_max_von_mises_Pa"):
        check.relative(f"2 ranks: {key}", two[key], base[key], 1e-12)
    check.relative("predicted creepage: the traction asked for", base["traction_coefficient"], 0.3, 1e-6)
    given = reference_only(f"Motion/Creepage={base['creepage']}")
    check.relative("creepage given: the same traction", given["traction_coefficient"], 0.3, 1e-4)
    check.relative("creepage given: the same adhesion share", given["adhesion_share"], base["adhesion_share"], 1e-3)
    torque = reference_only("Motion/Drive=torque", "Motion/Creepage=0", "Motion/Hold distance (mm)=10")
    check.relative("torque: its traction, whatever the start", torque["creepage"], base["creepage"], 1e-9)
    loaded = reference_only("Vehicle/Wheel load (kN)=100")
    check.relative("a given wheel load, N", loaded["normal_force_N"], 100e3, 1e-9)
    axle = reference_only("Vehicle/Axle load (t)=22.5", "Vehicle/Gravity (m per s2)=9.8")
    check.relative("a given axle load: half of it on each wheel, N", axle["normal_force_N"], 110.25e3, 1e-9)
    brake = reference_only("Motion/Traction coefficient=-0.3")
    check.relative("braking: the opposite creepage", brake["creepage"], -base["creepage"], 1e-5)
    slide = reference_only("Motion/Creepage=0.1")
    check.relative("creepage 0.1: traction is friction", slide["traction_coefficient"], 0.5, 1e-3)
    check.below("creepage 0.1: adhesion share", slide["adhesion_share"], 0.)
    smooth = reference_only("Contact/Friction coefficient=0", "Motion/Traction coefficient=0", "Motion/Creepage=0.002")
    check.below("no friction: shear stress, MPa", 1e-6 * smooth["max_shear_Pa"], 0.)
    check.relative("no friction: slip is creepage times speed", smooth["max_slip_m_per_s"], 0.002 * 140 / 3.6, 1e-9)
    for key in smooth:
        check.that(f"the same keys in every answer: {key}", all(key in other for other in (base, given, torque, slide)))
    # The head's crown arc holds the patch; it is a circle, the block's gap a parabola: (b/R)^2/4 of the gap, 1e-4.
    block = reference_only("Rail/Shape=block", "Rail/Crown radius (mm)=300")
    check.relative("head and block of the same crown: creepage", block["creepage"], base["creepage"], 1e-3)
    check.relative("head and block of the same crown: maximum pressure", block["max_pressure_Pa"], base["max_pressure_Pa"], 1e-3)
    # A load that presses the patch of 54E1 beyond the crown's 10 mm: the 80 mm arc falls away from the crown's extension,
    # which a block has.
    heavy = ["Vehicle/Sprung mass (kg)=150000", "Mesh/Fine half width (mm)=16", "Motion/Traction coefficient=0.1"]
    wide, crown = reference_only(*heavy), reference_only(*heavy, "Rail/Shape=block", "Rail/Crown radius (mm)=300")
    # An arc's patch is Hertz's, in closed form.
    check.relative("crown of a block: semi-axis b against Hertz", crown["semi_axis_y_m"],
                   crown["reference"]["semi_axis_y_m"]["Hertz"]["value"], 1e-9)
    check.that("patch beyond the crown of a head: narrower by more than 5 %",
               wide["semi_axis_y_m"] < 0.95 * crown["semi_axis_y_m"])
    check.that("patch beyond the crown of a head: higher pressure, by more than 0.3 %",
               wide["max_pressure_Pa"] > 1.003 * crown["max_pressure_Pa"])
    check.relative("patch beyond the crown: normal force, N", wide["normal_force_N"], 150900 * 9.81, 1e-9)
    aluminium = reference_only("Wheel/Young's modulus (GPa)=70", "Wheel/Poisson's ratio=0.33", "Mesh/Fine half width (mm)=10")
    softer = base["reference"]["max_pressure_Pa"]["Hertz"]["value"]
    check.that("aluminium wheel: lower pressure", aluminium["max_pressure_Pa"] < 0.8 * softer)
    check.relative("aluminium wheel: traction", aluminium["traction_coefficient"], 0.3, 1e-5)

    # An inclined rail under bodies of unlike steel: at the middle of the surface, pressed without friction,
    # sigma_x + sigma_y = (1 + 2 nu) sigma_z whatever the semi-axes (Johnson 1985, equation 3.64).
    unlike = reference_only("Rail/Inclination=1:40", "Wheel/Poisson's ratio=0.2", "Contact/Friction coefficient=0",
                            "Motion/Traction coefficient=0", output=path("unlike"))
    with open(os.path.join(path("unlike"), "subsurface.csv"), encoding="utf-8") as stream:
        top = {row["body"]: {key: float(row[key]) for key in ("y_mm", "xx_MPa", "yy_MPa", "zz_MPa")}
               for row in csv.DictReader(stream) if row["line"] == "centre" and float(row["depth_mm"]) == 0.}
    nodes = rows_of(path("unlike"), "patch.csv")
    centre = sum(row["area_mm2"] * row["pressure_MPa"] * row["y_mm"] for row in nodes) / sum(
        row["area_mm2"] * row["pressure_MPa"] for row in nodes)
    for body, poisson_ratio in (("wheel", 0.2), ("rail", 0.3)):
        stress = top[body]
        check.relative(f"{body}: sum of the stresses along the surface over that across it",
                       (stress["xx_MPa"] + stress["yy_MPa"]) / stress["zz_MPa"], 1. + 2. * poisson_ratio, 1e-6)
        check.absolute(f"{body}: stresses below the first contact, mm", stress["y_mm"], 1e3 * unlike["first_contact_y_m"], 1e-6)
    check.absolute("centre of the patch near the first contact of the inclined rail, mm", centre, top["rail"]["y_mm"], 0.6)

    # Bad input: one line, no files.
    def must_fail(what, arguments, words):
        output = path("bad")
        result = execute([*arguments_of(SCENE, output=output, command="reference"), *arguments], program=program)
        lines = result.stderr.strip().splitlines()
        check.that(f"{what}: exit code not 0", result.returncode in (1, 2))
        check.that(f"{what}: one line that names it", len(lines) == 1 and all(word in lines[0] for word in words))
        check.that(f"{what}: nothing written", not os.path.exists(output))
        print("   ", *lines)

    def setting(*values):
        return [argument for value in values for argument in ("-s", value)]

    must_fail("no load", setting("Vehicle/Gravity (m per s2)=0"), ["Gravity", "nothing loads the contact"])
    must_fail("negative load", setting("Wheel/Mass (kg)=-900"), ["Wheel/Mass (kg)", "allowed"])
    must_fail("traction beyond friction", setting("Motion/Traction coefficient=0.6"), ["Motion/Traction coefficient", "below"])
    must_fail("torque beyond friction", setting("Motion/Drive=torque", "Motion/Traction coefficient=-0.5"),
              ["Motion/Traction coefficient", "below"])
    must_fail("traction beyond what friction across the rail leaves", setting("Contact/Friction across (mm)=-100, 100", "Contact/Friction across factors=0.1, 0.3"),
              ["Motion/Traction coefficient", "below", "mean factor of 0.2 across"])
    must_fail("traction without friction", setting("Contact/Friction coefficient=0"), ["Motion/Traction coefficient", "below"])
    must_fail("negative friction", setting("Contact/Friction coefficient=-0.1"), ["Contact/Friction coefficient", "allowed"])
    must_fail("creepage that is no number", setting("Motion/Creepage=much"), ["Motion/Creepage", "predicted"])
    must_fail("incompressible rail", setting("Rail/Poisson's ratio=0.5"), ["Rail/Poisson's ratio", "allowed"])
    must_fail("with --resume", ["--resume"], ["--resume", "tread reference --help"])
    must_fail("with --dry-run", ["--dry-run"], ["--dry-run", "tread reference --help"])

check.exit()
