# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reader, filter, curvatures, as people write it in plain Python, with or without ParaView.

usage: TestSphericalStyleFilterPipeline.py DATA_FOLDER
"""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersGeneral import vtkCurvatures
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sphericalstyle import vtkSphericalStyleFilter

reader = vtkXMLPolyDataReader()
reader.SetFileName(os.path.join(sys.argv[1], "go-stone.vtp"))
reader.Update()
model = reader.GetOutput()
P = vtk_to_numpy(model.GetPoints().GetData()).astype(float)
F = vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def points(algorithm):
    algorithm.Update()
    return vtk_to_numpy(algorithm.GetOutput().GetPoints().GetData()).copy()


def array(algorithm, name):
    algorithm.Update()
    return vtk_to_numpy(algorithm.GetOutput().GetPointData().GetArray(name)).copy()


def radius_spread(Q):
    radii = np.linalg.norm(Q - Q.mean(axis=0), axis=1)
    return radii.std() / radii.mean()


# ----------------------------------------------------------------- reader -> filter -> curvatures
rounded = vtkSphericalStyleFilter()
rounded.SetInputConnection(reader.GetOutputPort())
rounded.SetRoundness(5.0)
rounded.SetSphericalWeightingToUniform()  # iterates, for the table
rounded.SetNormalBlend(0.0)  # and so goes to one ball, of the size that the energy gives it
rounded.SetDetailSize(0.0)
rounded.SetKeepSizeToOff()
rounded.SetRefineLongEdgesToOff()
rounded.SetOutputPointsPrecision(vtkSphericalStyleFilter.DOUBLE_PRECISION)
curvatures = vtkCurvatures()
curvatures.SetCurvatureTypeToMean()
curvatures.SetInputConnection(reader.GetOutputPort())
before = array(curvatures, "Mean_Curvature")
curvatures.SetInputConnection(rounded.GetOutputPort())
after = array(curvatures, "Mean_Curvature")
assert np.isfinite(after).all(), "curvatures of the result should be finite"
assert after.std() / after.mean() < 0.5 * before.std() / before.mean(), "and more even"

Q = points(rounded)
assert np.isfinite(Q).all() and Q.shape == P.shape
assert radius_spread(Q) < 0.3 * radius_spread(P), (radius_spread(Q), radius_spread(P))
assert np.allclose(Q.mean(axis=0), P.mean(axis=0), atol=1e-12), "the centroid should stay"
assert np.allclose(array(rounded, "Displacement"), Q - P, atol=1e-12)
assert (vtk_to_numpy(rounded.GetOutput().GetPolys().GetConnectivityArray()) == F.ravel()).all()
assert (vtk_to_numpy(model.GetPoints().GetData()) == P).all(), "the input should be as it was"

# ------------------------------------------------------- facts of the execution, and the formula of t
areas = 0.5 * np.linalg.norm(np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]), axis=1)
assert np.allclose(rounded.GetEffectiveCenter(), P.mean(axis=0), atol=1e-12)
assert np.isclose(rounded.GetEffectiveRadius(), np.sqrt(areas.sum() / (4.0 * np.pi)))
d = P - P.mean(axis=0)
d /= np.linalg.norm(d, axis=1, keepdims=True)
assert np.allclose(array(rounded, "TargetDirection"), d, atol=1e-12)

# ---------------------------------------------------------------------------- table of the energies
table = rounded.GetOutputDataObject(1)
total = vtk_to_numpy(table.GetColumnByName("Total"))
assert rounded.GetConverged() and len(total) == rounded.GetNumberOfIterations() + 1 > 2
assert total[-1] == rounded.GetFinalEnergy() > 0.0
assert (np.diff(total) <= 1e-12 * total[0]).all(), "the energy should never rise"

# ----------------------------------------------------------------------- an array made with numpy
factor = numpy_to_vtk(np.full(len(P), 0.1), deep=True)
factor.SetName("factor")
model.GetPointData().AddArray(factor)
by_array = vtkSphericalStyleFilter()
by_array.SetInputData(model)
by_array.SetRoundness(5.0)
by_array.SetOutputPointsPrecision(vtkSphericalStyleFilter.DOUBLE_PRECISION)
by_array.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "factor")
by_property = vtkSphericalStyleFilter()
by_property.SetInputData(model)
by_property.SetRoundness(0.5)
by_property.SetOutputPointsPrecision(vtkSphericalStyleFilter.DOUBLE_PRECISION)
assert np.allclose(points(by_array), points(by_property), rtol=0.0, atol=1e-12)

# ------------------------------------------------------------------------------------ an error
errors = []
by_array.AddObserver("ErrorEvent", lambda caller, event: errors.append(event))
by_array.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
by_array.SetRoundness(-1.0)
by_array.Update()
assert len(errors) == 1 and by_array.GetOutput().GetNumberOfPoints() == 0
by_array.SetRoundness(5.0)
assert np.allclose(points(by_array), points(by_property), rtol=0.0, atol=1e-12)
