# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces as arrays, with VTK's own reader."""
import os

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read(folder, name):
    """The surface in a file .vtp."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(folder, name))
    reader.Update()
    return reader.GetOutput()


def points(surface):
    return vtk_to_numpy(surface.GetPoints().GetData())


def faces(surface):
    """Of a surface of triangles."""
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
