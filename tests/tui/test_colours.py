#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of the terminal program: contrast in the usual palettes of 16 colours, and signs of good and bad that people with
any colour vision tell apart.

Contrast: WCAG 2.2, success criteria 1.4.3 (text, at least 4.5) and 1.4.11 (graphics, at least 3). A terminal chooses the colour of faint text; with two
thirds of its own it has at least 3, or 2 in such a palette. Colour vision: protanopia and deuteranopia by
Vienot, Brettel and Mollon (1999), distances in CIELAB (1976)."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import ROOT  # noqa: E402
from harness import expect, run_all  # noqa: E402

# name: the 16 colours, then background and text, dark and light; each as published with the terminal or the palette
PALETTES = {
    "xterm": ("000000 cd0000 00cd00 cdcd00 0000ee cd00cd 00cdcd e5e5e5 7f7f7f ff0000 00ff00 ffff00 5c5cff ff00ff 00ffff ffffff",
              ("000000", "e5e5e5"), ("ffffff", "000000")),
    "VGA": ("000000 aa0000 00aa00 aa5500 0000aa aa00aa 00aaaa aaaaaa 555555 ff5555 55ff55 ffff55 5555ff ff55ff 55ffff ffffff",
            ("000000", "aaaaaa"), ("ffffff", "000000")),
    "Tango": ("2e3436 cc0000 4e9a06 c4a000 3465a4 75507b 06989a d3d7cf 555753 ef2929 8ae234 fce94f 729fcf ad7fa8 34e2e2 eeeeec",
              ("000000", "d3d7cf"), ("ffffff", "2e3436")),
    "GNOME": ("171421 c01c28 26a269 a2734c 12488b a347ba 2aa1b3 d0cfcc 5e5c64 f66151 33d17a e9ad0c 2a7bde c061cb 33c7de ffffff",
              ("171421", "d0cfcc"), ("ffffff", "171421")),
    "Campbell": ("0c0c0c c50f1f 13a10e c19c00 0037da 881798 3a96dd cccccc 767676 e74856 16c60c f9f1a5 3b78ff b4009e 61d6d6 f2f2f2",
                 ("0c0c0c", "cccccc"), ("ffffff", "0c0c0c")),
    "Solarized": ("073642 dc322f 859900 b58900 268bd2 d33682 2aa198 eee8d5 002b36 cb4b16 586e75 657b83 839496 6c71c4 93a1a1 fdf6e3",
                  ("002b36", "839496"), ("fdf6e3", "657b83")),
}
GRAPHICS = {"GROUND", "TRAJECTORY", "STEM", "STOOL"}  # all other roles write text, too
FAINT = 2 / 3     # terminals show this share of a faint colour
DISTANCE_MIN = 25  # CIELAB; 2.3 is just noticeable

COLOURS = "BLACK RED GREEN YELLOW BLUE MAGENTA CYAN WHITE".split()
SOURCE = (ROOT / "src/tui/terminal.c").read_text()


def read_styles():
    """Return {role: (dark, light, attributes)}; -1 is the terminal's own colour."""
    def number(word):
        word = re.sub(r"COLOR_(\w+)", lambda m: str(COLOURS.index(m.group(1))), word).replace("BRIGHT", "8")
        return sum(map(int, word.split("+")))

    rows = re.findall(r"\[CEDUO_ROLE_([A-Z]+)\] = \{([^,{}]+), ([^,{}]+), (A_\w+)\}", SOURCE)
    roles = re.findall(r"^    X\((\w+), '", (ROOT / "src/view/cells.h").read_text(), re.M)
    expect(sorted(name for name, *_ in rows) == sorted(roles), rows, roles)
    return {name: (number(dark), number(light), attributes) for name, dark, light, attributes in rows}


def parts(colour):
    """Return red, green and blue as shares of light."""
    shares = (int(colour[i:i + 2], 16) / 255 for i in (0, 2, 4))
    return [share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares]


def luminance(colour):
    return sum(factor * part for factor, part in zip((0.2126, 0.7152, 0.0722), parts(colour)))


def contrast(one, other):
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def make_faint(colour, background):
    return "".join(f"{round(FAINT * int(colour[i:i + 2], 16) + (1 - FAINT) * int(background[i:i + 2], 16)):02x}" for i in (0, 2, 4))


def shown():
    """Return (palette, theme, role, attributes, colour, background) of each pair."""
    for palette, (colours, *themes) in PALETTES.items():
        for theme, (background, text) in enumerate(themes):
            for role, (*numbers, attributes) in read_styles().items():
                colour = colours.split()[numbers[theme]] if numbers[theme] >= 0 else text
                yield palette, theme, role, attributes, colour, background


def test_contrast():
    """Each colour on its background."""
    seen = 0
    for palette, theme, role, attributes, colour, background in shown():
        low = palette == "Solarized"
        wanted = 3 if role in GRAPHICS or low else 4.5
        if attributes == "A_DIM":
            colour = make_faint(colour, background)
            wanted = 2 if low else 3
        found = contrast(colour, background)
        expect(found >= wanted, f"{role} in {palette}, {('dark', 'light')[theme]}: {found:.2f}, at least {wanted} wanted")
        seen += 1
    expect(seen == 20 * 2 * len(PALETTES), seen)


def find_place(colour, vision):
    """Return a colour in CIELAB, as seen with this vision."""
    red, green, blue = parts(colour)
    if vision == "protanopia":
        red, green, blue = (0.11238 * red + 0.88762 * green, 0.11238 * red + 0.88762 * green,
                            0.00401 * red - 0.00401 * green + blue)
    elif vision == "deuteranopia":
        red, green, blue = (0.29275 * red + 0.70725 * green, 0.29275 * red + 0.70725 * green,
                            -0.02234 * red + 0.02234 * green + blue)
    white = (0.95047, 1, 1.08883)
    xyz = (0.4124 * red + 0.3576 * green + 0.1805 * blue, 0.2126 * red + 0.7152 * green + 0.0722 * blue,
           0.0193 * red + 0.1192 * green + 0.9505 * blue)
    x, y, z = (v / w if v / w < 0 else (v / w) ** (1 / 3) if v / w > 0.008856 else 7.787 * v / w + 16 / 116
               for v, w in zip(xyz, white))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def test_colour_blind():
    """The colours of good and bad differ for every kind of colour vision."""
    expect(abs(contrast("ffffff", "000000") - 21) < 1e-9, "contrast of black and white")
    colours = {}
    for palette, theme, role, _, colour, _ in shown():
        colours[palette, theme, role] = colour
    for palette in PALETTES:
        for theme in range(2):
            for vision in ("usual", "protanopia", "deuteranopia"):
                good, bad = (find_place(colours[palette, theme, role], vision) for role in ("GOOD", "BAD"))
                distance = sum((a - b) ** 2 for a, b in zip(good, bad)) ** 0.5
                expect(distance >= DISTANCE_MIN, f"GOOD and BAD in {palette}, {('dark', 'light')[theme]}, {vision}: {distance:.0f}")


if __name__ == "__main__":
    run_all(__name__)
