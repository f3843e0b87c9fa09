# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Sheets of small pictures, flat shaded as ParaView shows a surface without normals; back faces are blue."""
from PIL import Image
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProperty

import measures
import surfaces
from sphericalstyle import model_pictures

ROWS = 4  # models a sheet
BACK = (0.15, 0.35, 0.85)  # what faces inward and is seen all the same: a hole, or a triangle turned over
# Axis that points up, and degrees around it, for models that do not look along z with y up.
VIEWS = {
    "goblet-vase": ("z", 25.0),
    "lidar-sensor": ("z", 25.0),
    "lucy": ("z", 205.0),
    "plane-holes": ("z", 60.0),
    "spot": ("y", 215.0),
    "spot-small": ("y", 215.0),
}


def flat(surface):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    actor = vtkActor()
    actor.SetMapper(mapper)
    clay = actor.GetProperty()
    clay.SetInterpolationToFlat()
    clay.SetColor(model_pictures.CLAY)
    clay.SetAmbient(0.14)
    clay.SetDiffuse(0.88)
    clay.SetSpecular(0.10)
    clay.SetSpecularPower(12.0)
    back = vtkProperty()
    back.DeepCopy(clay)
    back.SetColor(BACK)
    actor.SetBackfaceProperty(back)
    return actor


def sheets(folder, models, titles):
    """models: (name, x, F, [Deformed of each title]). sheet-1.png and so on."""
    folder.mkdir(parents=True, exist_ok=True)
    for first in range(0, len(models), ROWS):
        strips = []
        for name, x, F, results in models[first:first + ROWS]:
            up, view = VIEWS.get(name, ("y", 25.0))
            # All in the units of the model's diagonal: one row, one scale.
            length = measures.diagonal(x)
            panels = [(surfaces.polydata(x / length, F), f"{name}, {len(x)} points")]
            panels += [(surfaces.polydata(r.x / length, r.F), title)
                       for title, r in zip(titles, results) if not r.failed]
            strip = folder / f"strip-{len(strips)}.png"
            model_pictures.picture(strip, (330 * len(panels), 300), [panels], up, view, 12, make_actor=flat)
            strips.append(strip)
        images = [Image.open(strip).convert("RGB") for strip in strips]
        sheet = Image.new("RGB", (images[0].width, sum(i.height for i in images)), "white")
        for k, image in enumerate(images):
            sheet.paste(image, (0, sum(i.height for i in images[:k])))
        sheet.quantize(128).save(folder / f"sheet-{first // ROWS + 1}.png", optimize=True)
        for strip in strips:
            strip.unlink()
