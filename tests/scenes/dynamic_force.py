#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The dynamic force of a run over its smooth twin, from histories that are known."""

import json
import math
import os
import sys
import tempfile
import zlib

from tread.runs import must_end_well
from loaded_once import execute_often
from tread_runner import Check, rows_of, script

program = sys.argv[1]
check = Check()

SPEED = 100 / 3.6
ROW = 0.25e-3  # m
STATIC = 116.8e3
BEGIN = -0.1001  # the blow, m: within a row
FREQUENCIES, DECREMENTS, AMPLITUDES = (297.0, 1061.0), (0.4, 0.6), (60e3, 30e3)
PAD_DELAY, PAD_SHARE = 0.1e-3, 0.5  # s


def blow(t):
    """N, t after the blow."""
    if t <= 0.0:
        return 0.0
    return sum(a * math.exp(-d * f * t) * math.sin(2 * math.pi * f * t) for f, d, a in zip(FREQUENCIES, DECREMENTS, AMPLITUDES))


def mean(signal, begin, end):
    """Over an interval, as the program records it: Simpson's rule."""
    return (signal(begin) + 4 * signal(0.5 * (begin + end)) + signal(end)) / 6


def smooth(t):
    """What a smooth rail has: load, and the passage of sleepers 0.6 m apart."""
    return STATIC + 3e3 * math.sin(2 * math.pi * SPEED / 0.6 * t)


def write_parameters(folder, settings):
    """parameters.prm, as a run writes it. The last setting of each name counts."""
    arguments = ["parameters"]
    for setting in {setting.partition("=")[0]: setting for setting in settings}.values():
        arguments += ["-s", setting]
    printed = must_end_well(execute_often(arguments, program))
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "parameters.prm"), "w", encoding="utf-8") as stream:
        stream.write(printed.stdout)


def write_summary(folder, **entries):
    """summary.json, of which readers take whether the run came to its end and what its history was."""
    with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as stream:
        json.dump(entries, stream)


def write(folder, rows, speed=SPEED, defect=False, shift=0.0, columns=("normal_force_N", "support_1_pad_N"), steps=None, settings=()):
    """What a run leaves; the last row is a short one, as a run's end gives. `shift`: rows begin later, m. `steps`: rows end with
    the first group of time steps, of this length (m), behind their place."""
    write_parameters(folder, [*settings, *(["Defect/Shape=dip", f"Defect/Position (mm)={1e3 * BEGIN:g}", "Defect/Depth (mm)=0.1"] if defect else []), "Defect/Length (mm)=20"])
    write_summary(folder, completed=True)
    with open(os.path.join(folder, "history.csv"), "w", encoding="utf-8") as stream:
        stream.write(",".join(("time_s", "position_m") + columns + ("creepage",)) + "\n")
        positions = [-0.3 + shift + ROW * i for i in range(rows)]
        if steps:
            positions = [math.ceil((x + 0.3) / steps - 1e-9) * steps - 0.3 for x in positions]
        positions.append(positions[-1] + 0.1 * ROW)
        before = positions[0] - ROW
        for x in positions:
            a, b = before / SPEED, x / SPEED
            since = lambda t: t - BEGIN / SPEED
            contact = mean(lambda t: smooth(t) + (blow(since(t)) if defect else 0.0), a, b)
            pad = mean(lambda t: 0.4 * smooth(t) + (PAD_SHARE * blow(since(t) - PAD_DELAY) if defect else 0.0), a, b)
            values = dict(normal_force_N=contact, support_1_pad_N=pad)
            stream.write(",".join(f"{value:.12g}" for value in [(x + 0.3) / speed, x] + [values[c] for c in columns] + [0.003]) + "\n")
            before = x


def fails(name, arguments, words, code=1):
    result = execute_often(arguments, program)
    lines = result.stderr.splitlines()
    if not check.that(name, result.returncode == code and len(lines) == 1 and all(word in lines[0] for word in words)):
        print(result.returncode, result.stderr)


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    # The twin's rows lie between those of the run, and it begins a little later.
    write(path("run"), 2000, defect=True)
    write(path("twin"), 2000, shift=0.4 * ROW)
    both = ["dynamic-force", path("run"), "--smooth-twin", path("twin")]
    result = execute_often(both, program)
    if not check.that("a run and its twin: exit code 0", result.returncode == 0):
        print(result.stdout, result.stderr)
        check.exit()
    check.that("the terminal has interpolation, window, resolution and a line for each force",
               all(word in result.stdout for word in ("interpolated linearly in time", "rectangular window", "resolution",
                                                      "normal_force_N", "support_1_pad_N")))

    with open(path("run/dynamic.json"), encoding="utf-8") as stream:
        figures = json.load(stream)
    rows = rows_of(path("run"), "dynamic.csv")
    contact, pad = figures["forces"]["normal_force_N"], figures["forces"]["support_1_pad_N"]
    check.that("dynamic.json says how rows were interpolated", figures["interpolation"] == "linear in time")
    # Means over an interval h differ from the value in its middle by (2 pi f h)^2/24, 1.5e-4 at 1061 Hz; so does what
    # lies between two rows of the twin. The onset is a kink of slope k, of which a mean misses up to k h/8.
    errors = [(abs(row["normal_force_N"] - blow((row["position_m"] - BEGIN) / SPEED)),
               abs(row["position_m"] - BEGIN)) for row in rows]
    check.below("contact: worst error of a row, kN", max(error for error, away in errors if away > ROW) / 1e3, 0.02)
    slope = sum(a * 2 * math.pi * f for a, f in zip(AMPLITUDES, FREQUENCIES))
    check.below("contact: error at the onset, kN", max(error for error, away in errors if away <= ROW) / 1e3,
                slope * ROW / SPEED / 8 / 1e3)
    times = [1e-6 * i for i in range(100000)]
    peak = max(times, key=lambda t: abs(blow(t)))
    check.relative("contact: peak", contact["peak_N"], blow(peak), 2e-3)
    check.absolute("contact: where, mm", 1e3 * contact["peak_position_m"], 1e3 * (BEGIN + SPEED * peak), 0.5e3 * ROW + 0.01)
    check.absolute("contact: when, ms", 1e3 * contact["peak_time_s"], 1e3 * ((BEGIN + 0.3) / SPEED + peak), 0.5e3 * ROW / SPEED + 1e-3)
    check.relative("contact: force of the run at the peak", contact["force_at_peak_N"],
                   blow(peak) + smooth(BEGIN / SPEED + peak), 2e-3)
    for key, extreme in (("increase", max), ("decrease", min)):
        when = extreme(times, key=blow)
        check.relative(f"contact: largest {key}", contact[f"largest_{key}_N"], blow(when), 2e-3)
        check.absolute(f"contact: largest {key}, where, mm", 1e3 * contact[f"largest_{key}_position_m"], 1e3 * (BEGIN + SPEED * when), 0.5e3 * ROW + 0.01)
    check.relative("contact: mean of the twin", contact["smooth_mean_N"], STATIC, 0.02)
    check.relative("pad: peak", pad["peak_N"], PAD_SHARE * blow(peak), 2e-3)
    check.absolute("pad: later than the contact, ms", 1e3 * (pad["peak_time_s"] - contact["peak_time_s"]),
                   1e3 * PAD_DELAY, 1e3 * ROW / SPEED)
    check.absolute("contact: number of vibrations", len(contact["oscillations"]), 2, 0)
    for line, frequency, decrement in zip(contact["oscillations"], FREQUENCIES, DECREMENTS):
        # The top of a decaying line lies beside its frequency by (decrement/2 pi)^2 of it; a line is certain to a tenth
        # of the resolution.
        check.absolute(f"contact: {frequency:.0f} Hz: frequency, Hz", line["frequency_Hz"], frequency,
                       (decrement / (2 * math.pi)) ** 2 * frequency + 0.1 * figures["resolution_Hz"])
        check.relative(f"contact: {frequency:.0f} Hz: wavelength x frequency over speed",
                       line["wavelength_m"] * line["frequency_Hz"] / SPEED, 1.0, 1e-6)
        check.relative(f"contact: {frequency:.0f} Hz: decrement", line["logarithmic_decrement"] or math.nan, decrement, 0.10)
    spectrum = rows_of(path("run"), "spectrum.csv")
    largest = max(spectrum, key=lambda row: row["normal_force_N"])
    check.absolute("spectrum.csv: largest amplitude, distance to the first vibration in values",
                   (largest["frequency_Hz"] - contact["oscillations"][0]["frequency_Hz"]) / figures["frequency_interval_Hz"],
                   0.0, 0.51)
    check.relative("spectrum.csv: wavelength x frequency over speed", largest["wavelength_m"] * largest["frequency_Hz"] / SPEED, 1.0, 1e-6)
    check.relative("spectrum.csv: its amplitude", largest["normal_force_N"], contact["oscillations"][0]["amplitude_N"], 0.01)

    said = {window: must_end_well(execute_often(both + ["--window", window, "--from", "-100", "--to", "100", "--output", path("section")], program)).stdout
            for window in ("rectangular", "Hann")}
    check.that("a section that ends while the force swings: side lobes are named", "side lobes" in said["rectangular"])
    check.that("a Hann window has none", "WARNING" not in said["Hann"])
    quiet = must_end_well(execute_often(both + ["--quiet", "--output", path("quiet")], program))
    check.that("--quiet: nothing on the screen, the tables are there", quiet.stdout == "" and os.path.exists(path("quiet/dynamic.json")))
    with open(path("section/dynamic.json"), encoding="utf-8") as stream:
        section = json.load(stream)
    check.absolute("a section: begins, mm", 1e3 * section["from_m"], -100, 1e3 * ROW)
    check.absolute("a section: ends, mm", 1e3 * section["to_m"], 100, 1e3 * ROW)
    check.relative("a section: Hann's resolution x record", section["resolution_Hz"] * section["record_s"], 2.0, 1e-9)

    # Groups of eight steps of 3.3 and of 3.1 um: rows have nine or ten of the run's, ten or eleven of the twin's. Between rows a
    # straight line misses up to (2 pi f h)^2/8 of a wave, the mean of a row (2 pi f h)^2/24.
    write(path("steps-run"), 2000, defect=True, steps=26.4e-6)
    write(path("steps-twin"), 2000, steps=24.8e-6)
    result = execute_often(["dynamic-force", path("steps-run"), "--smooth-twin", path("steps-twin")], program)
    if check.that("a twin with other time steps: exit code 0", result.returncode == 0):
        rows = rows_of(path("steps-run"), "dynamic.csv")
        worst = max(abs(row["normal_force_N"] - blow((row["position_m"] - BEGIN) / SPEED)) for row in rows
                    if abs(row["position_m"] - BEGIN) > 1.2 * ROW)
        check.below("a twin with other time steps: worst error of a row, kN", worst / 1e3,
                    sum(a * (2 * math.pi * f * 1.1 * ROW / SPEED) ** 2 / 6 for a, f in zip(AMPLITUDES, FREQUENCIES)) / 1e3)
    else:
        print(result.stderr)

    write(path("fast-run"), 2000, speed=1.4 * SPEED, defect=True, settings=["Motion/Speed (km per h)=140"])
    write(path("fast-twin"), 2000, speed=1.4 * SPEED, settings=["Motion/Speed (km per h)=140.0"])
    drawn = script("plot/plot-impact.py", path("run"), path("fast-run"), "--smooth-twin", path("twin"), path("fast-twin"),
                   "--program", program, "--output", path("pictures"))
    if not check.that("pictures of two speeds", drawn.returncode == 0 and set(os.listdir(path("pictures"))) == {
            f"{name}.png" for name in ("contact-force", "dynamic-force", "supports", "distribution", "speeds")}):
        print(drawn.stdout, drawn.stderr)

    # 54E1, pads and ballast of 1300 and 45 MN/m: characteristic length and largest share of a support as published.
    write(path("on-track"), 2000)
    with open(path("on-track/parameters.prm"), "w", encoding="utf-8") as stream:
        stream.write("subsection Rail\nset Profile = 54E1\nset Young's modulus (GPa) = 210\nend\nsubsection Track\n"
                     "set Foundation = two-layer\nset Sleeper spacing (m) = 0.6\nset Support 0 (mm) = -500\n"
                     "set Pad stiffness (MN per m) = 1300\nset Ballast stiffness (MN per m) = 45\nend\n")
    table = script("plot/plot-impact.py", path("on-track"), "--zimmermann").stdout
    rows = [[float(cell.split()[0]) for cell in line.strip("| ").split("|")] for line in table.splitlines()[2:]]
    check.that("Zimmermann: two instants", len(rows) == 2)
    for row, at, distance in zip(rows, (-200.0, 25.0), (0.3, 0.075)):
        share = 100 * 48.57 / 116.8 * math.exp(-distance / 0.7214) * (math.cos(distance / 0.7214) + math.sin(distance / 0.7214))
        check.absolute(f"Zimmermann: support 1 at {at:.0f} mm: the wheel's position, mm", row[0], at, 0.01)
        check.absolute(f"Zimmermann: support 1 at {at:.0f} mm: share, %", row[2], 40.0, 0.01)
        check.absolute(f"Zimmermann: support 1 at {at:.0f} mm: by the beam, %", row[3], share, 0.01)
        check.absolute(f"Zimmermann: support 1 at {at:.0f} mm: difference, %", row[4], 100 * (40.0 / share - 1), 0.1)

    fails("no twin named", ["dynamic-force", path("run")], ["--smooth-twin"])
    fails("a scene beside", both + ["scene.prm"], ["scene.prm", "tread dynamic-force --help"])
    fails("a parameter beside", both + ["-s", "Motion/Speed (km per h)=100"], ["-s", "tread dynamic-force --help"])
    fails("another tool's", ["sleeper-stress", path("run"), "--smooth-twin", path("twin")], ["--smooth-twin", "tread sleeper-stress --help"])
    fails("no such folder", ["dynamic-force", path("none"), "--smooth-twin", path("twin")], ["no folder", "none"])
    os.makedirs(path("empty"))
    fails("no history", ["dynamic-force", path("run"), "--smooth-twin", path("empty")], ["history.csv", "empty"])
    write(path("short"), 10)
    fails("too few rows", ["dynamic-force", path("run"), "--smooth-twin", path("short")], ["11 rows", "at least 16"])
    write(path("fast"), 2000, speed=1.4 * SPEED)
    fails("another speed", ["dynamic-force", path("run"), "--smooth-twin", path("fast")], ["100 km/h", "140 km/h"])
    write(path("lighter"), 2000, settings=["Vehicle/Sprung mass (kg)=9000"])
    fails("a twin of another vehicle", ["dynamic-force", path("run"), "--smooth-twin", path("lighter")], ["Vehicle/Sprung mass (kg)", "9000"])
    write(path("elsewhere"), 2000, shift=2.0)
    fails("a twin elsewhere", ["dynamic-force", path("run"), "--smooth-twin", path("elsewhere")], ["elsewhere", "does not cover"])
    write(path("stopped"), 1500)
    stopped = ["dynamic-force", path("run"), "--smooth-twin", path("stopped"), "--output", path("stopped-section")]
    fails("a twin that stopped before the run", stopped, ["stopped", "to 74.", "does not cover", "to 199."])
    check.that("a section that it covers", execute_often(stopped + ["--to", "70"], program).returncode == 0)
    fails("a section of a few rows", both + ["--from", "10", "--to", "11"], ["4 intervals", "at least 16"])
    said = must_end_well(execute_often(both + ["--from", "-100", "--to", "300", "--output", path("section")], program)).stdout
    check.that("a section beyond the history: where it ends instead", "WARNING: --to 300.00 mm" in said and "reaches 199." in said and "--from" not in said)
    with open(path("run/history.csv"), "rb") as stream:
        sum_of_history = zlib.crc32(stream.read())
    write_summary(path("run"), completed=True, history_crc32=sum_of_history)
    check.that("a history with its checksum", "has no summary" not in must_end_well(execute_often(both, program)).stdout)
    write_summary(path("run"), completed=True, history_crc32=sum_of_history ^ 1)
    fails("a history that was edited", both, ["run/history.csv", "changed"])
    write_summary(path("run"), completed=False, history_crc32=sum_of_history)
    check.that("a run that was interrupted is named", f"WARNING: {path('run')} has no summary of a completed run" in must_end_well(execute_often(both, program)).stdout)
    write_summary(path("run"), completed=True)
    write(path("contact"), 2000, columns=("normal_force_N",))
    fails("a column that the twin has not", ["dynamic-force", path("run"), "--smooth-twin", path("contact")],
          ["contact/history.csv", "support_1_pad_N"])
    write(path("nothing"), 2000, columns=())
    fails("no forces", ["dynamic-force", path("nothing"), "--smooth-twin", path("twin")], ["nothing/history.csv", "_N"])
    write(path("damaged"), 20)
    with open(path("damaged/history.csv"), "a", encoding="utf-8") as stream:
        stream.write("1,2\n")
    fails("a row that is cut off", ["dynamic-force", path("damaged"), "--smooth-twin", path("twin")], ["row 22", "2 entries"])
    write(path("nan"), 2000)
    with open(path("nan/history.csv"), encoding="utf-8") as stream:
        lines = [line.rstrip("\n").split(",") for line in stream]
    lines[100][lines[0].index("normal_force_N")] = "nan"
    with open(path("nan/history.csv"), "w", encoding="utf-8") as stream:
        stream.write("\n".join(",".join(line) for line in lines) + "\n")
    fails("a force that is none", ["dynamic-force", path("nan"), "--smooth-twin", path("twin")], ["row 100", "nan"])
    fails("an unknown window", both + ["--window", "Hamming"], ["Hamming", "rectangular", "Hann"])
    fails("no position", both + ["--from", "here"], ["--from", "here", "mm"])
    fails("not a number", both + ["--from", "nan"], ["--from", "nan", "mm"])
    fails("from behind to", both + ["--from", "100", "--to", "-100"], ["--from 100", "--to -100"])

    # Only the defect, the output and the title may differ.
    write_parameters(path("run"), ["Defect/Shape=dip", "Defect/Length (mm)=20", "Defect/Depth (mm)=0.1", "Defect/Position (mm)=-40",
                                   "Output/History interval (mm)=0.5", "Scene/Title=a dip", "Motion/Speed (km per h)=140"])
    for settings, settles in ([], True), (["Defect/Length (mm)=20"], False):
        write_parameters(path("twin"), ["Motion/Speed (km per h)=140.0", *settings])
        allowed = execute_often(both, program)
        if not check.that("defect, output and title differ, and 140 is 140.0", allowed.returncode == 0):
            print(allowed.stderr)
        with open(path("run/dynamic.json"), encoding="utf-8") as stream:
            warnings = json.load(stream)["warnings"]
        check.that(f"the axle of the twin {'settles' if settles else 'has its inertia'}: {'' if settles else 'no '}warning",
                   any("settles under its load" in text and path("twin") in text for text in warnings) == settles)
    for setting, before in (("Motion/Speed (km per h)=100", "140"), ("Contact/Friction coefficient=0.4", "0.5"),
                            ("Rail/Hardening=kinematic", "isotropic")):
        write_parameters(path("twin"), ["Motion/Speed (km per h)=140", "Time stepping/Levels=2", setting])
        name, _, value = setting.partition("=")
        fails(f"the twin has another {name}", both, [f"'{name}'", f"'{before}'", f"'{value}'", path("run"), path("twin")])
    write_parameters(path("twin"), ["Motion/Speed (km per h)=140", "Defect/Shape=dip", "Defect/Length (mm)=20", "Defect/Depth (mm)=0.1"])
    fails("the twin has a defect, too", both, ["'Defect/Shape'", "'dip'", path("twin")])
    fails("both folders are one", ["dynamic-force", path("run"), "--smooth-twin", path("run")], ["'Defect/Shape'", path("run")])
    write_parameters(path("twin"), ["Motion/Speed (km per h)=140"])
    fails("exchanged", ["dynamic-force", path("twin"), "--smooth-twin", path("run")], ["'Defect/Shape'", "'dip'", path("run")])
    fails("neither has a defect", ["dynamic-force", path("twin"), "--smooth-twin", path("twin")], ["'Defect/Shape' is 'none'", path("twin")])
    # Files of one name may have other contents; those of the defect may be unlike.
    def has_read(name, parameter, content):
        with open(path(f"{name}/parameters.prm"), "a", encoding="utf-8") as stream:
            read = dict(parameter=parameter, path="tread.txt", bytes=len(content), crc32=zlib.crc32(content))
            stream.write(f"# file read: {json.dumps(read)}\n")
    has_read("run", "Wheel/Tread profile", b"0 0")
    said = must_end_well(execute_often(both, program)).stdout
    check.that("a twin that does not say what it has read is named", "WARNING" in said and "'Wheel/Tread profile'" in said and "not known" in said)
    has_read("twin", "Wheel/Tread profile", b"0 1")
    fails("the twin has read another content", both, ["no smooth twin", "'Wheel/Tread profile'", "'tread.txt'", str(zlib.crc32(b"0 0")), str(zlib.crc32(b"0 1"))])
    write_parameters(path("twin"), ["Motion/Speed (km per h)=140"])
    has_read("twin", "Wheel/Tread profile", b"0 0")
    has_read("run", "Defect/Profile file", b"0 0.1")
    check.that("the same content, and a defect's file", "not known" not in must_end_well(execute_often(both, program)).stdout)
    os.remove(path("twin/parameters.prm"))
    fails("no parameters", both, ["twin/parameters.prm"])

check.exit()
