#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `tread --contact-points` left: where both wheels of a wheelset touch, contact angle, rolling radii and equivalent conicity over the shift.

    plot-contact-points.py FOLDER [--picture contact-points.png]
"""

import os

from tread import Run
from tread.commands import command_parser, run_command
from tread.pictures.contact_points import draw_contact_points
from tread.plots import save, use_style


def main():
    parser = command_parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--picture", help="default: contact-points.png in the folder")
    arguments = parser.parse_args()
    use_style()
    save(draw_contact_points(Run(arguments.folder)), arguments.picture or os.path.join(arguments.folder, "contact-points.png"))


if __name__ == "__main__":
    run_command(main)
