# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player: makes a ball of few triangles without normals, the same with normals, a
cube of small triangles without normals, and a surface with a cell of points that are not there. The ball is then the active one."""
from paraview import simple

BALL = """
import vtk
source = vtk.vtkSphereSource()
source.GenerateNormalsOff()
source.Update()
self.GetOutput().ShallowCopy(source.GetOutput())
"""
CUBE = """
import vtk
source = vtk.vtkPlatonicSolidSource()
source.SetSolidTypeToCube()
triangles = vtk.vtkTriangleFilter()
triangles.SetInputConnection(source.GetOutputPort())
split = vtk.vtkLinearSubdivisionFilter()
split.SetInputConnection(triangles.GetOutputPort())
split.SetNumberOfSubdivisions(3)
split.Update()
self.GetOutput().ShallowCopy(split.GetOutput())
self.GetOutput().GetCellData().Initialize()
"""
BROKEN = BALL + """
output = self.GetOutput()
polys = vtk.vtkCellArray()
polys.DeepCopy(output.GetPolys())
polys.InsertNextCell(3)
for point in (0, 1, 1000000):
    polys.InsertCellPoint(point)
output.SetPolys(polys)
"""

view = simple.GetActiveViewOrCreate("RenderView")
for name, script in (("Broken", BROKEN), ("Cube", CUBE), ("Shaded", BALL.replace("Off", "On")), ("Ball", BALL)):
    model = simple.ProgrammableSource(registrationName=name, Script=script)
    model.OutputDataSetType = "vtkPolyData"
    model.UpdatePipeline()
simple.Show(model, view)
simple.SetActiveSource(model)
simple.Render(view)
