"""Takes the light out of a scan and shows it beside what is left: show.py SCAN PICTURE.png"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import relamp


def encoded(linear):
    """Linear light as a screen shows it, about sRGB."""
    return linear.clip(0, 1) ** (1 / 2.2)


def main(scan: str, picture: str, quality: str = "standard") -> None:
    room = relamp.delight(scan, quality=quality)
    parts = {
        "scan = albedo × shading": encoded(room.albedo * room.shading),
        "albedo": encoded(room.albedo),
        "shading": encoded(0.5 * room.shading),
        "confidence": room.confidence,
    }
    figure, axes = plt.subplots(1, 4, figsize=(16, 4.4), layout="constrained")
    for axis, (name, values) in zip(axes, parts.items()):
        axis.imshow(values, cmap="gray", vmin=0, vmax=1)
        axis.set_title(name)
        axis.axis("off")
    figure.savefig(picture, dpi=80)
    for fixture in room.lights.fixtures:
        print(f"{fixture.name}: {fixture.area:.2f} m², radiance {max(fixture.radiance):.1f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
