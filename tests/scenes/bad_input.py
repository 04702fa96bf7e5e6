#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user may get wrong: each ends with one line that names the parameter, a non-zero exit code,
and the results of an earlier run untouched."""

import fcntl
import json
import os
import sys
import tempfile

from tread.runs import ROOT, arguments_of
from loaded_once import execute_often, execute_on
from tread_runner import Check

program = sys.argv[1]
scene = os.path.join(ROOT, "prm", "smooth-rolling.prm")
check = Check()

# What is typed, and words that the answer must contain.
SETTINGS = [
    ("Contact/Friction coeficient=0.3", ["Contact/Friction coeficient", "did you mean", "Contact/Friction coefficient"]),
    ("Wheel/Friction coefficient=0.3", ["Wheel/Friction coefficient", "Contact/Friction coefficient"]),
    ("Contacts/Friction coefficient=0.3", ["Contacts", "Contact/Friction coefficient"]),
    ("Mesh/Finest cell (mm)=-0.63", ["Mesh/Finest cell (mm)", "allowed", "0.02"]),
    ("Time stepping/Courant number=1.02", ["Time stepping/Courant number", "allowed", "1"]),
    ("Mesh/Finest cell (mm)=fine", ["Mesh/Finest cell (mm)", "allowed"]),
    ("Mesh/Finest cell (mm)=9", ["Mesh/Finest cell (mm)", "too large for a patch", "at most"]),
    ("Mesh/Fine half width (mm)=4", ["Mesh/Fine half width (mm)", "at least"]),
    ("Mesh/Fine half width (mm)=45", ["Mesh/Fine half width (mm)", "half width of the rail"]),
    ("Mesh/Fine layers=64", ["Mesh/Fine layers", "do not fit", "at most"]),
    ("Mesh/Coarsest cell (mm)=0.5", ["Mesh/Coarsest cell (mm)", "at least", "Mesh/Finest cell (mm)"]),
    ("Contact/Friction coefficient=-0.1", ["Contact/Friction coefficient", "allowed", "0"]),
    ("Contact/Friction coefficient=0.3", ["Motion/Traction coefficient", "below", "Contact/Friction coefficient"]),
    ("Motion/Speed (km per h)=0", ["Motion/Speed (km per h)", "at least 0.1"]),
    ("Motion/Speed (km per h)=1e-200", ["Motion/Speed (km per h)", "at least 0.1"]),
    ("Motion/Drive=rocket", ["Motion/Drive", "creepage", "torque"]),
    ("Motion/Creepage=abc", ["Motion/Creepage", "predicted"]),
    ("Motion/Creepage=0.9", ["Motion/Creepage", "0.2"]),
    ("Rail/Margin (mm)=5", ["Rail/Margin (mm)", "leave the rail"]),
    ("Wheel/Sector margin (mm)=2", ["Wheel/Sector margin (mm)", "leave the sector"]),
    ("Motion/Speed (km/h)=100", ["Motion/Speed (km/h)", "did you mean", "Motion/Speed (km per h)"]),
    ("Motion/Speed=100", ["Motion/Speed", "did you mean", "Motion/Speed (km per h)"]),
    ("Wheel/Mass (kg)=1e308", ["Wheel/Mass (kg)", "Vehicle/Sprung mass (kg)", "at most"]),
    ("Wheel/Mass (kg)=0", ["Wheel/Mass (kg)", "allowed"]),
    ("Wheel/Mass (kg)=1", ["Wheel/Mass (kg)", "too small"]),
    ("Vehicle/Sprung mass (kg)=1e-9", ["Vehicle/Sprung mass (kg)", "Suspension stiffness", "no suspension does"]),
    ("Vehicle/Gravity (m per s2)=0", ["Vehicle/Gravity (m per s2)", "above 0"]),
    ("Vehicle/Wheel load (kN)=5", ["Vehicle/Wheel load (kN)", "less than the weight", "Wheel/Mass (kg)", "8.829"]),
    ("Vehicle/Axle load (t)=1.7", ["Vehicle/Axle load (t)", "less than twice", "Wheel/Mass (kg)", "1.8 t"]),
    ("Vehicle/Wheel load (kN)=heavy", ["Vehicle/Wheel load (kN)", "masses"]),
    ("Rail/Poisson's ratio=0.7", ["Rail/Poisson's ratio", "allowed", "0.49"]),
    ("Rail/Yield stress (MPa)=-500", ["Rail/Yield stress (MPa)", "allowed", "0"]),
    ("Rail/Hardening=wood", ["Rail/Hardening", "isotropic", "kinematic", "Armstrong-Frederick"]),
    ("Rail/Plastic zones=-30:-20:8:400", ["'Rail/Plastic zones'", "begin:end:depth"]),
    ("Wheel/Plastic zones=-30:-20:8:soft:21", ["'Wheel/Plastic zones'", "begin:end:depth"]),
    ("Rail/Plastic zones=-30:500:8:400:21", ["Rail/Plastic zones", "500", "leaves the mesh"]),
    ("Rail/Plastic zones=-20:-30:8:400:21", ["Rail/Plastic zones", "-20"]),
    ("Rail/Plastic zones=-30:-20:900:400:21", ["Rail/Plastic zones", "900", "leaves the mesh"]),
    ("Rail/Plastic zones=-30:-20:8:0:21", ["Rail/Plastic zones", "yield stress 0", "above 0"]),
    ("Rail/Plastic zones=-30:-20:8:-400:21", ["Rail/Plastic zones", "yield stress -400", "above 0"]),
    ("Rail/Plastic zones=-30:-20:8:400:210", ["Rail/Plastic zones", "tangent modulus 210", "below Young's modulus"]),
    ("Motion/Passages=0", ["Motion/Passages", "allowed"]),
    ("Wheel/Tread profile=S1003", ["Wheel/Tread profile", "S1003", "cannot be read", "S1002"]),
    ("Wheel/Lateral position (mm)=99", ["Wheel/Lateral position (mm)", "allowed"]),
    ("Output/Cells=-20,0", ["Output/Cells", "x,y,depth"]),
    ("Output/Cells=-20,0,0", ["Output/Cells", "depth above 0"]),
    ("Rail/Inclination=1:30", ["Rail/Inclination", "1:40", "1:20"]),
    ("Rail/Measured head=nothing.prr", ["Rail/Measured head", "nothing.prr", "cannot be read"]),
    ("Rail/Length (mm)=100", ["Rail/Begin (mm)", "Length (mm)", "must hold the path", "from -90 to 60 mm"]),
    ("Rail/Begin (mm)=-70", ["Rail/Begin (mm)", "from -70 to 60 mm", "must hold the path"]),
    ("Rail/Begin (mm)=here", ["Rail/Begin (mm)", "'here'", "automatic"]),
    ("Motion/Start (mm)=nan", ["Motion/Start (mm)", "'nan'", "automatic"]),
    ("Defect/Shape=crater", ["Defect/Shape", "dip", "profile"]),
    ("Defect/Shape=dip", ["Defect/Length (mm)", "Defect/Depth (mm)"]),
    ("Defect/Shape=profile", ["Defect/Profile file"]),
    ("Mesh/Fine from (mm)=5", ["Mesh/Fine from (mm)", "Mesh/Fine to (mm)"]),
    ("Mesh/Path cell (mm)=0.5", ["Mesh/Path cell (mm)", "0.5", "at least 'Mesh/Finest cell (mm)' 0.63", "or 0"]),
    ("Mesh/Path cell (mm)=5", ["Mesh/Path cell (mm)", "Mesh/Fine from (mm)"]),
    ("Rail/Profile=50E6", ["Rail/Profile", "54E1", "60E1"]),
    ("Rail/Profile=UIC60", ["Rail/Profile", "54E1", "is called 60E1 here"]),
    ("Rail/Profile=136RE", ["Rail/Profile", "not built in", "Rail/Measured head"]),
    ("Wheel/Tread profile=LMA", ["Wheel/Tread profile", "LMA is not built in", "profile-from-arcs.py"]),
    ("Scene/Density scale=0.5", ["Scene/Density scale", "allowed"]),
    ("Scene/Density scale=1000", ["Scene/Density scale", "allowed"]),
    ("Motion/Rolled distance (mm)=0", ["Motion/Rolled distance (mm)", "allowed"]),
    ("Friction coefficient", ["expected Section/Name=value"]),
    ("0.35=Contact/Friction coefficient", ["the parameter comes first", '"Contact/Friction coefficient=0.35"']),
    ("0.35=0.4", ["'0.35' is no parameter", "expected Section/Name=value"]),
]
# A bar of 7.2 m with a support every 0.6 m.
BAR = ["Rail/Shape=block", "Rail/Block width (mm)=60", "Rail/Block height (mm)=150", "Rail/Margin (mm)=3570",
       "Track/Foundation=two-layer", "Track/Pad width (mm)=50", "Track/Support 0 (mm)=-330", "Scene/Density scale=1",
       "Motion/Rolled distance (mm)=60"]
DIP = ["Defect/Shape=dip", "Defect/Length (mm)=20", "Defect/Depth (mm)=0.1"]
PAIRS = [
    (["Vehicle/Axle load (t)=20", "Vehicle/Wheel load (kN)=98.1"], ["Vehicle/Axle load (t)", "Vehicle/Wheel load (kN)", "one of them"]),
    (["Track/Foundation=two-layer"], ["Track/Foundation", "Rail/Shape"]),
    (BAR + ["Track/Sleeper spacing (m)=0.65"], ["Track/Sleeper spacing (m)", "does not fit the rail"]),
    (BAR + ["Track/Support 0 (mm)=-600"], ["Track/Sleeper spacing (m)", "begins 30 mm before its first support", "half a spacing"]),
    (BAR + ["Track/Support 0 (mm)=-630"], ["begins 0 mm before its first support", "half a pad, 75,"]),
    (BAR + ["Rail/Margin (mm)=3300", "Rail/Begin (mm)=-3630", "Rail/Length (mm)=6950"], ["ends 50 mm behind its last support", "half a pad, 75,"]),
    (BAR + ["Track/Sleeper spacing (m)=9"], ["Track/Sleeper spacing (m)", "at least 2"]),
    (BAR + ["Track/Pad length (mm)=700"], ["Track/Pad length (mm)", "below the sleeper spacing"]),
    (BAR + ["Track/Pad width (mm)=140"], ["Track/Pad width (mm)", "rail's base"]),
    (BAR + ["Scene/Quasi-static=true", "Scene/Density scale=4"], ["Scene/Density scale", "Track/Foundation"]),
    (["Rail/Ends=absorbing"], ["Rail/Ends", "Track/Foundation"]),
    (BAR + ["Rail/Ends=absorbing", "Rail/Absorbing length (m)=3"], ["Rail/Absorbing length (m)", "at most 2.97"]),
    (["Rail/Ends=endless"], ["Rail/Ends", "Track/Foundation"]),
    (BAR + ["Rail/Ends=endless", "Track/Pads pull=false"], ["Rail/Ends", "Track/Pads pull", "linear"]),
    (BAR + ["Rail/Ends=endless", "Rail/Margin (mm)=100", "Rail/Begin (mm)=-3630", "Rail/Length (mm)=7200", "Motion/Start (mm)=-3400"], ["Rail/Ends", "230 mm of an end", "300 mm"]),
    (BAR + ["Rail/Ends=endless", "Rail/Spans beyond=3"], ["Rail/Spans beyond", "4"]),
    (["Contact/Friction temperatures (C)=20,300", "Contact/Friction temperature factors=1,0.5"], ["Contact/Friction temperatures (C)", "Damage/Record"]),
    (["Contact/Friction temperatures (C)=20,300", "Contact/Friction temperature factors=1,0.5", "Damage/Record=true", "Damage/Heat share of the wheel=0.5"],
     ["Contact/Friction temperatures (C)", "Damage/Heat share of the wheel", "automatic"]),
    (["Contact/Friction temperatures (C)=20,300", "Contact/Friction temperature factors=1,0.5", "Damage/Record=true", "Contact/Friction law=falling"],
     ["Contact/Friction temperatures (C)", "Contact/Friction law"]),
    (["Contact/Friction temperatures (C)=300,20", "Contact/Friction temperature factors=1,0.5", "Damage/Record=true"], ["Contact/Friction temperatures (C)", "300", "below 20"]),
    (["Contact/Friction temperatures (C)=20", "Contact/Friction temperature factors=1,0.5", "Damage/Record=true"], ["Contact/Friction temperatures (C)", "1 entries", "2"]),
    (["Contact/Friction temperatures (C)=20,1600", "Contact/Friction temperature factors=1,0.5", "Damage/Record=true"], ["Contact/Friction temperatures (C)", "1600", "1500"]),
    (BAR + ["Output/Supports=0,17"], ["Output/Supports", "17"]),
    (BAR + ["Track/Sleepers=solid", "Track/Sleeper length (m)=1.2"], ["Track/Sleeper length (m)", "Rail distance"]),
    (BAR + ["Track/Points across=1", "Rail/Crown radius (mm)=100"], ["Track/Points across", "at least 2", "tips over", "150 mm"]),
    (BAR + ["Track/Points across=1", "Wheel/Tread profile=cone 1:40"], ["Track/Points across", "at least 2", "y = 0"]),
    (BAR + ["Track/Points across=1", "Rail/Shape=full section", "Rail/Inclination=1:40"],
     ["Track/Points across", "at least 2", "Rail/Inclination"]),
    (BAR + DIP + ["Track/Points across=1", "Defect/Position (mm)=-30", "Defect/Lateral position (mm)=5"],
     ["Track/Points across", "at least 2", "defect"]),
    (["Mesh/Finest cell (mm)=0.02", "Mesh/Fine half width (mm)=20", "Motion/Rolled distance (mm)=2000"], ["Mesh/Finest cell (mm)", "million cells", "GB"]),
    (["Solid/Element=fully-integrated", "Rail/Poisson's ratio=0.49"], ["Solid/Element", "locks", "Rail/Poisson's ratio", "0.45"]),
    (DIP + ["Defect/Position (mm)=50"], ["Defect/Position (mm)", "50", "70", "outside the rail"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Width (mm)=0.5"], ["Defect/Width (mm)", "0.5", "Mesh/Finest cell (mm)", "1.26"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Length (mm)=0.4"], ["Defect/Length (mm)", "0.4", "Mesh/Finest cell (mm)"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Reversed=true"], ["Defect/Reversed", "profile", "edges exchanged"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Width (mm)=1.2"], ["Defect/Width (mm)", "1.2", "twice", "1.26"]),
    (["Peak stress/Region=trailing edge"], ["Peak stress/Region", "needs a defect"]),
    (["Peak stress/Region=range"], ["Peak stress/From (mm)", "below 'To (mm)'"]),
    (["Peak stress/Region=range", "Peak stress/From (mm)=-500", "Peak stress/To (mm)=-400"], ["Peak stress", "must lie on the path"]),
    (["Peak stress/Region=range", "Peak stress/From (mm)=-20", "Peak stress/To (mm)=40"], ["Peak stress", "must lie on the path"]),
    (["Peak stress/Region=range", "Peak stress/From (mm)=-20", "Peak stress/Depth (mm)=1.2"], ["Peak stress/Depth (mm)", "two layers", "1.26"]),
    (["Peak stress/Region=range", "Peak stress/From (mm)=-20", "Peak stress/To (mm)=-10", "Mesh/Fine from (mm)=-15", "Mesh/Fine to (mm)=0", "Mesh/Path cell (mm)=1.26"],
     ["Peak stress", "from -20 to -10", "finest cells", "from -15 to 0"]),
    (DIP + ["Defect/Position (mm)=-30", "Peak stress/Region=trailing edge", "Defect/Lateral position (mm)=20", "Defect/Width (mm)=8"],
     ["Peak stress", "does not meet the defect", "Lateral position (mm)"]),
    (["Peak stress/Region=range", "Peak stress/From (mm)=-20", "Peak stress/Half width (mm)=99"], ["Peak stress/Half width (mm)", "exceeds"]),
    (DIP + ["Defect/Position (mm)=-900"], ["Defect/Position (mm)", "outside the rail"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Width (mm)=80"], ["Defect/Width (mm)", "40 mm", "head"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Lateral position (mm)=30"], ["Lateral position (mm)", "head"]),
    (DIP + ["Defect/Position (mm)=-30", "Defect/Rounded leading edge (mm)=30"], ["Rounded leading edge (mm)", "at most half"]),
    (["Defect/Shape=profile", "Defect/Profile file=nothing.txt"], ["Defect/Profile file", "nothing.txt", "cannot be read"]),
    (["Mesh/Fine from (mm)=200", "Mesh/Fine to (mm)=300"], ["Mesh/Fine from (mm)", "on the rail from -90 to 60 mm"]),
    (["Rail/Shape=block", "Rail/Inclination=1:40"], ["Rail/Inclination", "full section"]),
    (["Wheel/Tread profile=S1002", "Rail/Inclination=1:40", "Mesh/Fine half width (mm)=6"],
     ["Mesh/Fine half width (mm)", "must hold the patch from y = -", "at least"]),
    (["Wheel/Tread profile=S1002", "Rail/Inclination=1:40", "Wheel/Lateral position (mm)=2"], ["leaves", "Wheel/Lateral position (mm)"]),
    (["Scene/Quasi-static=false", "Scene/Density scale=9"], ["Scene/Density scale", "Quasi-static"]),
    (["Scene/Quasi-static=false", "Scene/Density scale=1"], ["Solid/Mass damping (1 per s)", "Quasi-static"]),
    (DIP + ["Defect/Position (mm)=-30"], ["Scene/Density scale", "must be 1", "'Defect/Shape' dip"]),
    (DIP + ["Defect/Position (mm)=-30", "Scene/Density scale=1"], ["Solid/Mass damping (1 per s)", "must be 0", "'Defect/Shape' dip"]),
    (BAR, ["Solid/Mass damping (1 per s)", "must be 0", "'Track/Foundation' two-layer"]),
    (["Solid/Stiffness damping (time steps)=0"], ["Time stepping/Levels", "Solid/Stiffness damping (time steps)", "at least 0.1"]),
    (["Solid/Stiffness damping (time steps)=0.01", "Time stepping/Levels=2"], ["Time stepping/Levels", "Solid/Stiffness damping (time steps)"]),
    (["Scene/Density scale=100", "Motion/Speed (km per h)=500"], ["Scene/Density scale", "inertia error"]),
    (["Scene/Density scale=100", "Wheel/Young's modulus (GPa)=70"], ["Scene/Density scale", "inertia error"]),
    (["Motion/Drive=torque", "Motion/Speed (km per h)=0"], ["Motion/Speed (km per h)", "torque"]),
    (["Contact/Friction places (mm)=-16"], ["Contact/Friction places (mm)", "Contact/Friction factors", "each place has a factor"]),
    (["Contact/Friction places (mm)=-16, -18", "Contact/Friction factors=1, 0.5"], ["Contact/Friction places (mm)", "-16", "-18"]),
    (["Contact/Friction pressures (MPa)=900"], ["Contact/Friction pressures (MPa)", "Contact/Friction pressure factors", "each pressure has a factor"]),
    (["Contact/Friction pressures (MPa)=900, 600", "Contact/Friction pressure factors=1, 0.5"], ["Contact/Friction pressures (MPa)", "900", "600"]),
    (["Contact/Friction places (mm)=-90", "Contact/Friction factors=0.5"], ["Motion/Traction coefficient", "where the wheel begins"]),
    (["Motion/Drive=torque", "Motion/Hold distance (mm)=80"], ["Motion/Hold distance (mm)", "Rolled distance"]),
    (["Wheel/Shape=full", "Wheel/Bore radius (mm)=200"], ["Wheel/Bore radius (mm)", "Hub outer radius"]),
    (["Wheel/Shape=full", "Wheel/Web thickness (mm)=140"], ["Wheel/Web thickness (mm)", "Wheel/Rim width (mm)"]),
    (["Rail/Shape=block", "Rail/Crown radius (mm)=50"], ["Rail/Crown radius (mm)", "Rail/Block width (mm)"]),
    (["Rail/Shape=block", "Rail/Block height (mm)=5"], ["Rail/Block height (mm)", "crown"]),
    (["Rail/Yield stress (MPa)=500", "Rail/Tangent modulus (GPa)=210"], ["Rail/Tangent modulus (GPa)", "below Young's"]),
    (["Wheel/Yield stress (MPa)=500", "Wheel/Tangent modulus (GPa)=300"], ["Wheel/Tangent modulus (GPa)", "below Young's"]),
    (["Rail/Yield stress (MPa)=500", "Rail/Plastic depth (mm)=400"], ["Rail/Plastic depth (mm)", "leaves the mesh"]),
    (["Wheel/Yield stress (MPa)=500", "Wheel/Plastic half width (mm)=90"], ["Wheel/Plastic half width (mm)", "leaves the mesh"]),
    (["Rail/Yield stress (MPa)=500", "Rail/Hardening=Armstrong-Frederick", "Rail/Backstress moduli (GPa)=60, 20"],
     ["Rail/Backstress moduli (GPa)", "Rail/Backstress recoveries"]),
    (["Track/Foundation=two-layer", "Track/Pad stiffness (MN per m)=1e9"], ["Track/Pad stiffness (MN per m)", "1e9", "1e+08"]),
    (["Track/Foundation=two-layer", "Track/Pad stiffness (MN per m)=1e-6"], ["Track/Pad stiffness (MN per m)", "1e-6"]),
    (["Track/Foundation=two-layer", "Track/Pad damping (kN s per m)=1e6"], ["Track/Pad damping (kN s per m)", "1e6"]),
    (["Mesh/Finest cell (mm)=0.02", "Motion/Rolled distance (mm)=2000"], ["Mesh/Finest cell (mm)", "million cells", "GB"]),
    (["Rail/Yield stress (MPa)=500", "Solid/Element=fully-integrated"], ["Rail/Yield stress (MPa)", "one-point"]),
    (["Solid/Element=fully-integrated", "Solid/Linear bulk viscosity=0.06"], ["Solid/Linear bulk viscosity", "fully-integrated"]),
]

with tempfile.TemporaryDirectory() as folder:
    results = os.path.join(folder, "results")
    os.mkdir(results)
    with open(os.path.join(results, "summary.json"), "w", encoding="utf-8") as stream:
        stream.write("kept")

    def must_fail(what, arguments, words, ranks=1):
        result = execute_on(ranks, arguments, program, timeout=120)
        lines = [line for line in result.stderr.splitlines() if line.startswith("tread:")]
        check.that(f"{what}: exit code not 0", result.returncode not in (0,) and result.returncode > 0)
        if not check.that(f"{what}: one line", len(lines) == 1):
            print(result.stdout[-500:], result.stderr[-2000:])
        for word in words:
            if not check.that(f"{what}: says '{word}'", any(word in line for line in lines)):
                print("   ", lines)
        with open(os.path.join(results, "summary.json"), encoding="utf-8") as kept:
            check.that(f"{what}: earlier results kept", kept.read() == "kept" and len(os.listdir(results)) == 1)

    base = [scene, "--output", results]
    for setting, words in SETTINGS:
        must_fail(setting, base + ["-s", setting], words)
    for settings, words in PAIRS:
        must_fail(" and ".join(settings), arguments_of(scene, settings, results), words)
    for second in ("80", "100"):
        must_fail(f"a parameter twice, the second time to {second}", base + ["-s", "Motion/Speed (km per h)=80", "-s", f" Motion/Speed (km per h) = {second}"],
                  ["-s", "'Motion/Speed (km per h)' twice", "'80'", f"'{second}'"])
    must_fail("on 3 ranks", base + ["-s", "Motion/Drive=rocket"], ["Motion/Drive"], ranks=3)
    coarse = ["-s", "Mesh/Finest cell (mm)=1.3", "-s", "Mesh/Fine half width (mm)=9"]
    must_fail("a cell beyond the end of the rail, on 3 ranks", base + coarse + ["-s", "Output/Cells=-20,0,1; 900,0,1"],
              ["Output/Cells", "entry 2", "outside the rail"], ranks=3)
    must_fail("the same when the run is only estimated", base + coarse + ["--dry-run", "-s", "Output/Cells=-20,0,1; 900,0,1"],
              ["Output/Cells", "entry 2", "outside the rail"])
    must_fail("on 3 ranks, when the mesh is known", base + coarse + ["-s", "Wheel/Mass (kg)=1"], ["Wheel/Mass (kg)"], ranks=3)

    # Files with measured profiles.
    for name, text, words in (("gap", "0 0\n1 -.1\n2 -.2\n3 -.2\n30 0\n31 0\n", ["line 5", "gap of 27 mm"]),
                              ("columns", "0 0 1\n1 -.1 1\n2 -.2 1\n3 0 1\n", ["line 1", "two numbers"]),
                              ("the columns of a map", "x_mm,y_mm,z_mm\n0,-1,0\n0,1,0\n1,-1,0\n1,1,0\n", ["line 1", "map of heights", "'Defect/Shape' map"]),
                              ("backwards", "0 0\n2 -.1\n1 -.2\n3 0\n", ["line 3", "x must increase"]),
                              ("one point", "x z\n0 0 # begins\n", ["has 1 point;", "at least four"]),
                              ("comments", "0 0 # begins\n1 -.1 ! falls\n2 .1 # rises\n3 0\n4 0 0\n", ["line 5", "two numbers"]),
                              ("hill", "0 0\n1 .1\n2 .1\n3 0\n", ["above the line between its ends", "raised weld"])):
        with open(os.path.join(folder, name + ".txt"), "w", encoding="utf-8") as stream:
            stream.write(text)
        must_fail(f"profile with {name}", base + ["-s", "Defect/Shape=profile", "-s", "Defect/Profile file=" + stream.name],
                  ["Defect/Profile file", *words])
    must_fail("a folder as profile", base + ["-s", "Defect/Shape=profile", "-s", "Defect/Profile file=" + folder],
              ["Defect/Profile file", "is a folder"])
    with open(os.path.join(folder, "narrow.prr"), "w", encoding="utf-8") as stream:
        stream.write("point.begin\n" + "".join(f"{y} {1e-3 * y * y}\n" for y in range(-9, 10)) + "point.end\n")
    must_fail("a measured head that is too narrow", base + ["-s", "Rail/Measured head=" + stream.name],
              ["Rail/Measured head", "-9 mm to 9 mm", "12 mm"])

    must_fail("a folder as scene", [folder, "--output", results], [folder, "is a folder"])
    must_fail("missing file", [os.path.join(folder, "nothing.prm"), "--output", results], ["nothing.prm"])
    must_fail("no scene", ["--output", results], ["no scene"])
    must_fail("unknown option", base + ["--fast"], ["--fast"])
    must_fail("option without its value", [scene, "--output"], ["--output"])
    must_fail("resume without checkpoint", base + coarse + ["--resume"], ["no checkpoint"])

    # What a run that was killed leaves is no lock; only a run that goes on has one.
    with open(os.path.join(results, ".lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        os.rename(results, os.path.join(folder, "busy"))
        os.mkdir(results)
        os.rename(os.path.join(folder, "busy", "summary.json"), os.path.join(results, "summary.json"))
        must_fail("another run has the folder", [scene, "--output", os.path.join(folder, "busy")] + coarse,
                  ["another run writes into"], ranks=2)
    must_fail("the other run was killed", [scene, "--output", os.path.join(folder, "busy"), "--resume"] + coarse,
              ["no checkpoint"])

    with open(os.path.join(folder, "empty.prm"), "w", encoding="utf-8") as stream:
        stream.write("# nothing\n")
    for name, text, words in (("unknown entry", "# a scene\nsubsection Contact\n  set Frictoin coefficient = 1\nend\n",
                               ["bad.prm', line 3", "no parameter 'Contact/Frictoin coefficient'", "did you mean 'Contact/Friction coefficient'"]),
                              ("unit left out", "subsection Wheel\n\n  set Mass = 900\nend\n", ["line 3", "'Wheel/Mass'", "did you mean 'Wheel/Mass (kg)'"]),
                              ("unknown section", "subsection Contract\n  set Friction coefficient = 1\nend\n", ["line 1", "no section 'Contract'", "did you mean 'Contact'"]),
                              ("unknown section without entries", "subsection Contract\nend\n", ["line 1", "no section 'Contract'"]),
                              ("no end", "\nsubsection Contact\n  set Friction coefficient = 0.4\n", ["line 2", "'subsection Contact' has no 'end'"]),
                              ("no end before the next", "subsection Contact\n  set Friction coefficient = 0.4\nsubsection Wheel\nend\n",
                               ["line 3", "'subsection Wheel'", "line 1", "no 'end'"]),
                              ("an end too many", "subsection Contact\nend\nend\n", ["line 3", "'end' without a 'subsection'"]),
                              ("no set", "subsection Contact\n  Friction coefficient = 0.4\nend\n", ["line 2", "must begin with 'set'"]),
                              ("no set, misspelt", "subsection Contact\n  Friction coeficient = 0.4\nend\n", ["line 2", "must begin with 'set'", "did you mean"]),
                              ("no subsection", "Contact\n  set Friction coefficient = 0.4\nend\n", ["line 1", "'Contact' must begin with 'subsection'"]),
                              ("no equals", "subsection Contact\n  set Friction coefficient 0.4\nend\n", ["line 2", "Friction coefficient"]),
                              ("no value", "subsection Contact\n  set Friction coefficient\nend\n", ["line 2", "'=' is missing"]),
                              ("outside of its section", "set Contact/Friction coefficient = 0.4\n", ["line 1", "outside of its section", "subsection Contact"]),
                              ("no line of a scene", "subsection Contact\n  hello\nend\n", ["line 2", "cannot read 'hello'", "set NAME = VALUE"]),
                              ("a study by its scene", "set Scene = ../a.prm\n", ["is a study", "contrib/study.py"]),
                              ("a study by what varies", "subsection Vary\n  set Motion/Creepage = 0.1 | 0.2\nend\n", ["is a study"]),
                              ("a parameter twice", "subsection Motion\n  set Speed (km per h) = 80\n  set Speed  (km per h) = 80\nend\n",
                               ["line 3", "'Motion/Speed (km per h)' is set in line 2 already"]),
                              ("a parameter twice, in two parts of a section", "subsection Motion\n  set Speed (km per h) = 80\nend\n\nsubsection Motion\n  set Speed (km per h) = 100\nend\n",
                               ["line 6", "'Motion/Speed (km per h)' is set in line 2 already"]),
                              ("nothing", "", ["bad.prm' sets no parameter", "prm/", "tread parameters"]),
                              ("comments alone", "# a scene\n\n  # to be written\n", ["bad.prm' sets no parameter"]),
                              ("a section without entries", "subsection Motion\nend\n", ["bad.prm' sets no parameter"]),
                              ("includes a file that sets nothing", "include empty.prm\n", ["bad.prm' sets no parameter"]),
                              ("a line in two", "subsection Contact\n  set Friction coefficient = \\\n    -4\nend\n", ["line 2", "'-4'", "allowed"]),
                              ("value out of range", "subsection Contact\n  set Friction coefficient = -4\nend\n",
                               ["line 2", "'Contact/Friction coefficient' cannot be '-4'; allowed: 0 to 2"])):
        path = os.path.join(folder, "bad.prm")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)
        must_fail(name, [path, "--output", results], words)

    # Files wrong in their form, which once ended the program without a word, or did not end it.
    path = os.path.join(folder, "bad.prm")
    for name, content, words in (("includes itself", b"include bad.prm\n", ["included by itself"]),
                                 ("includes itself in capitals", b"INCLUDE bad.prm\n", ["included by itself"]),
                                 ("includes itself in two lines", b"incl\\\nude bad.prm\n", ["included by itself"]),
                                 ("includes a long name", b"include " + 200000 * b"a", ["cannot read parameter file"]),
                                 ("has a long line", 300000 * b" " + b"\nsubsection Motion\n", ["subsection"]),
                                 ("has a long value", b"subsection Motion\n set Drive = [Selection " + 200000 * b"b" + b"\nend\n",
                                  ["Drive", "creepage", " ... "]),
                                 ("is UTF-16", "subsection Motion\nend\n".encode("utf-16"), ["UTF-16", "save the file"]),
                                 ("is no text", bytes(range(256)), ["no text"]),
                                 ("is not UTF-8", "subsection Scene\n set Title = Pr\xfcfstand\nend\n".encode("latin-1"),
                                  ["line 2", "UTF-8"])):
        with open(path, "wb") as stream:
            stream.write(content)
        must_fail("a parameter file that " + name, [path, "--output", results], words)
    # What editors of other systems leave is read: a byte order mark, ends of lines, capitals and tabs.
    for name, content in (("a byte order mark", b"\xef\xbb\xbfsubsection Motion\n  set Speed (km per h) = 77\nend\n"),
                          ("carriage returns", b"subsection Motion\r  set Speed (km per h) = 77\rend\r"),
                          ("both ends of lines", b"subsection Motion\r\n  set Speed (km per h) = 77\r\nend\r\n"),
                          ("capitals and tabs", b"SUBSECTION\tMotion\n\tSET Speed\t(km per h)  =\t77 # fast\nEND\n")):
        with open(path, "wb") as stream:
            stream.write(content)
        read = json.loads(execute_often(["parameters", path, "--json", "-s", "Scene/Title=read"], program).stdout)
        check.that(f"a parameter file with {name} is read", read["Motion"]["Speed (km per h)"]["value"] == "77")
    # A file that includes another one sets again what that sets, and its settings may be all on the command line.
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("subsection Motion\n  set Speed (km per h) = 77\nend\n")
    with open(os.path.join(folder, "own.prm"), "w", encoding="utf-8") as stream:
        stream.write("include bad.prm\nsubsection Motion\n  set Speed (km per h) = 88\nend\n")
    for name, settings, speed in (("own.prm", [], "88"), ("empty.prm", ["Motion/Speed (km per h)=99"], "99")):
        read = json.loads(execute_often(["parameters", *arguments_of(os.path.join(folder, name), settings), "--json"], program).stdout)
        check.that(f"{name} with {settings}: {speed} km/h", read["Motion"]["Speed (km per h)"]["value"] == speed)
    must_fail("a setting that is not UTF-8", base + ["-s", b"Scene/Title=Pr\xfcfstand"], ["-s", "UTF-8"])
    steps = os.path.join(folder, "map.csv")
    with open(steps, "w", encoding="utf-8") as stream:
        stream.write("x_mm,y_mm,z_mm\n" + "".join(f"{i},{i},0.1\n" for i in range(60000)))
    must_fail("a map of a diagonal, whose grid would take gigabytes", base + ["-s", "Defect/Shape=map", "-s", "Defect/Profile file=" + steps],
              ["Defect/Profile file", "60000 x 60000", "x 1 mm, y 0 mm", "is missing"])
    must_fail("a batch from a pipe", ["batch", "/dev/null", "--output", os.path.join(folder, "answers.csv")], ["tread batch", "twice"])

    for what in ([], ["reference"]):
        must_fail("the root of a flange that an upright wheel does not have", [*what, *base, "-s", "Wheel/Tread profile=S1002", "-s",
                  "Wheel/Lateral position (mm)=20", "-s", "Rail/Inclination=1:40"], ["root of the flange", "Wheelset/Lateral shift (mm)"])
    must_fail("a sector that is too narrow for its fine zone", base + ["-s", "Mesh/Finest cell (mm)=1.3", "-s", "Wheel/Sector width (mm)=20"], ["Wheel/Sector width (mm)", "too small"])

    # Root may write anywhere but not below a file.
    blocked = os.path.join(folder, "a-file")
    with open(blocked, "w", encoding="utf-8") as stream:
        stream.write("x")
    for ranks in (1, 3):
        must_fail(f"folder cannot be written, {ranks} rank(s)", [scene, "--output", os.path.join(blocked, "results")] + coarse,
                  ["Output/Directory"], ranks)

    # What another parameter leaves without effect is named; what is set to what it is anyhow is not.
    unused = {"Defect/Depth (mm)=3": "Defect/Shape", "Track/Pad stiffness (MN per m)=100": "Track/Foundation", "Wheel/Bore radius (mm)=90": "Wheel/Shape",
              "Rail/Tangent modulus (GPa)=10": "Rail/Yield stress (MPa)", "Contact/Friction memory (mm)=1": "Contact/Friction law",
              "Wheelset/Track gauge (mm)=1400": "Wheelset/Lateral shift (mm)", "Peak stress/To (mm)=5": "Peak stress/Region", "Rail/Absorbing length (m)=1": "Track/Foundation",
              "Rail/Spans beyond=8": "Rail/Ends", "Damage/Rail temperature (C)=30": "Contact/Friction temperatures (C)", "Track/Stiffness along the rail (MN per m)=50": "Rail/Ends",
              "Mesh/Longest row (mm)=30": "Rail/Shape", "Vehicle/Sprung mass (kg)=9000": "Vehicle/Wheel load (kN)", "Wheel/Tangent modulus (GPa)=10": "Wheel/Hardening",
              "Contact/Least speed of memory (m per s)=0.1": "Contact/Friction law"}
    settings = [text for setting in [*unused, "Guidance/File=", "Vehicle/Wheel load (kN)=140", "Wheel/Yield stress (MPa)=500", "Wheel/Hardening=Armstrong-Frederick", "Wheel/Backstress moduli (GPa)=10", "Wheel/Backstress recoveries=100", "Motion/Hold distance (mm)=15.0"] for text in ("-s", setting)]
    said = [line for line in execute_often([scene, "--dry-run"] + coarse + settings, program).stdout.splitlines() if "WARNING" in line]
    for setting, needed in unused.items():
        check.that(f"{setting} without effect: needs {needed}", any(f"'{setting.split('=')[0]}' has no effect" in line and f"'{needed}'" in line for line in said))
    check.that("and nothing else", len(said) == len(unused))

    seldom = execute_often([scene, "--dry-run", *coarse, "-s", "Output/History interval (mm)=70"], program)
    check.that("a history interval longer than the way", any("WARNING" in line and "'Output/History interval (mm)' 70 is longer than the way" in line
                                                             for line in seldom.stdout.splitlines()))
    usual = execute_often([scene, "--dry-run", *coarse], program)
    check.that("and none that is shorter", usual.returncode == 0 and "WARNING" not in usual.stdout)

    printed = execute_often(["parameters", "-s", "Motion/Speed (km per h)=123"], program)
    as_json = json.loads(execute_often(["parameters", "--json", "-s", "Motion/Speed (km per h)=123"], program).stdout)
    check.that("parameters --json has the same", as_json["Motion"]["Speed (km per h)"]["value"] == "123")
    quiet = execute_often([scene, "--quiet", "--dry-run", "--output", results], program)
    check.that("--quiet says nothing", quiet.returncode == 0 and quiet.stdout == quiet.stderr == "")
    must_fail("--quiet says what is wrong", base + ["--quiet", "-s", "Motion/Speed (km per h)=-1"], ["Motion/Speed (km per h)", "allowed"])
    check.that("parameters without a scene shows what was set", "set Speed (km per h) " in printed.stdout and "= 123" in printed.stdout)

check.exit()
