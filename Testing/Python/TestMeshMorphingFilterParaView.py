# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The chain in ParaView over every kind of cell, by the quality that ParaView measures, and the picture: cut open.

usage: pvpython TestMeshMorphingFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import smtesting
from paraview.simple import *

from ProxyTesting import same_picture

plugin = sys.argv[1]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def chain(cell):
    """A cube of cells, and the same morphed to its rounded surface."""
    blocks = UnstructuredCellTypes(CellType=cell, BlocksDimensions=[8, 8, 8])
    grid = Transform(Input=blocks)
    grid.Transform.Scale, grid.Transform.Translate = [0.7 / 8] * 3, [-0.35, 0.1, -0.35]
    style = SphericalStyle(Input=ExtractSurface(Input=grid), DetailSize=0.0)
    UpdatePipeline(proxy=style)
    return grid, MeshMorphing(Input=grid, Surface=style)


def cut(grid):
    half = Clip(Input=grid, ClipType="Plane", Crinkleclip=1)
    half.ClipType.Origin, half.ClipType.Normal = [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]
    return half


morphed = {}
for cell in ("Tet", "Pyramid", "Wedge", "Hex"):
    grid, morphed[cell] = chain(cell)
    quality = MeshQuality(Input=morphed[cell], TetQualityMeasure="Scaled Jacobian", HexQualityMeasure="Scaled Jacobian")
    UpdatePipeline(proxy=quality)
    morphed[cell].UpdatePipelineInformation()
    smallest = morphed[cell].GetPropertyValue("SmallestScaledJacobianAfter")
    assert smallest > 0.0, cell
    if cell in ("Tet", "Hex"):  # ParaView 5.11 offers no scaled Jacobian of the others
        measured = quality.CellData["Quality"].GetRange()[0]
        assert abs(measured - smallest) < 1e-5, (cell, measured, smallest)

if not same_picture((grid, cut(morphed["Hex"]), cut(morphed["Tet"]), cut(morphed["Wedge"])),
                    "Surface With Edges"):
    sys.exit("Failed Image Test")
