# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player: opens a ball of few triangles without normals, the same with normals, a
cube of small triangles without normals, and a surface with a cell of points that are not there. The ball is then the
active one. They are files, for the panel of a Programmable Source ends ParaView 5.13 where Pygments is missing."""
import pathlib

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource, vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def ball(normals):
    source = vtkSphereSource()
    source.SetGenerateNormals(normals)
    source.Update()
    return source.GetOutput()


def cube():
    source = vtkPlatonicSolidSource()
    source.SetSolidTypeToCube()
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    split = vtkLinearSubdivisionFilter()
    split.SetInputConnection(triangles.GetOutputPort())
    split.SetNumberOfSubdivisions(3)
    split.Update()
    model = vtkPolyData()
    model.SetPoints(split.GetOutput().GetPoints())
    model.SetPolys(split.GetOutput().GetPolys())
    return model


def broken():
    model = ball(False)
    cells = vtkCellArray()
    cells.DeepCopy(model.GetPolys())
    cells.InsertNextCell(3)
    for point in (0, 1, 1000000):
        cells.InsertCellPoint(point)
    model.SetPolys(cells)
    return model


view = simple.GetActiveViewOrCreate("RenderView")
home = pathlib.Path.home()  # that of the tests; readers read again while the player plays
for name, surface in (("Broken", broken()), ("Cube", cube()), ("Shaded", ball(True)), ("Ball", ball(False))):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(home / f"{name}.vtp"))
    writer.SetInputData(surface)
    writer.SetDataModeToAscii()
    writer.Write()
    reader = simple.XMLPolyDataReader(registrationName=name, FileName=[writer.GetFileName()])
    reader.UpdatePipeline()
simple.Show(reader, view)
simple.SetActiveSource(reader)
simple.Render(view)
