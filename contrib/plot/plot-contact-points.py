#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread contact-points` left: where both wheels of a wheelset touch, contact angle, rolling radii and equivalent conicity over the shift;
and both profiles as they were read, in the track. Over a rail of slices: where the wheel touches along the way, which part carries, and the path of the axle.

    plot-contact-points.py FOLDER [--picture contact-points.png] [--profiles profiles.png]
"""

from __future__ import annotations

import os

from tread import Run
from tread.commands import command_parser, run_command
from tread.pictures.contact_points import draw_contact_points, draw_profiles
from tread.pictures.contact_way import draw_contact_way
from tread.plots import save, use_style


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--picture", help="default: contact-points.png in the folder")
    parser.add_argument("--profiles", help="picture of the profiles; default: profiles.png in the folder")
    arguments = parser.parse_args()
    use_style()
    run = Run(arguments.folder)
    if os.path.exists(run.path("contact_way.csv")):
        save(draw_contact_way(run), arguments.picture or run.path("contact-points.png"))
        return
    for draw, picture, default in ((draw_contact_points, arguments.picture, "contact-points.png"), (draw_profiles, arguments.profiles, "profiles.png")):
        save(draw(run), picture or os.path.join(arguments.folder, default))


if __name__ == "__main__":
    run_command(main)
