# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The models and filters that experiments use."""
import functools
import pathlib

import models
import sphericalstyle
from sphericalstyle import model_files
from sphericalstyle.messages import Messages
from surfaces import columns

# Settings that the experiments need, regardless of the filters' defaults: weights and center of the thesis, the pull
# toward one ball as large as the model, no details kept, no splitting and no scaling.
SETTINGS = {
    "vtkThesisStyleFilter": {
        "Roundness": 0.5, "NormalBlend": 0.0, "NormalRadius": 1, "DetailSize": 0.0, "SphericalWeighting": 0,
        "CenterMode": 0, "KeepSize": 0, "RefineLongEdges": 0, "OutputPointsPrecision": 1},
    "vtkNonlinearStyleFilter": {"Roundness": 0.5, "CenterMode": 0, "OutputPointsPrecision": 1},
    "vtkConvexProxyDeformFilter": {"CenterMode": 0, "RefineLongEdges": 0},
}
ROOT = pathlib.Path(__file__).resolve().parents[2]


class Context:
    """size: "small" or "full"; models_folder: a folder with real models, or None."""

    def __init__(self, size="full", models_folder=None):
        self.size = size
        self.models_folder = models_folder
        self.read = set()  # names of the real models that experiments took
        self.model = functools.lru_cache(maxsize=None)(self._model)

    @property
    def small(self):
        return self.size == "small"

    def choose(self, small, full):
        """Chooses one of two values, depending on the size of the run."""
        return small if self.small else full

    def _model(self, name, **parameters):
        """A shape of models.py, or else a file of Data/ by its stem. Never change it: it is shared."""
        if name in models.SHAPES:
            coarse = models.COARSE.get(name, {}) if self.small else {}
            return models.SHAPES[name](**(coarse | parameters))
        return model_files.read(ROOT / "Data" / f"{name}.vtp")

    def real(self, name):
        """A model of the folder --models as NAME.ply (or .obj, .stl, .vtp), or None."""
        if self.models_folder is None:
            return None
        for ending in model_files.READERS:
            file = self.models_folder / f"{name}{ending}"
            if file.is_file():
                self.read.add(name)
                return model_files.read(file)
        return None

    @staticmethod
    def has(name):
        """Whether the package has this class."""
        return hasattr(sphericalstyle, name)

    @staticmethod
    def run(name, surface, others=None, arrays=None, **properties):
        """The executed filter of this class.

        others: {port: data}; arrays: {index: (association, name)}, 0 for points and 1 for cells;
        properties by their VTK names. Raises model_files.ModelError with the filter's message.
        """
        algorithm = getattr(sphericalstyle, name)()
        messages = Messages(algorithm)
        algorithm.SetInputData(0, surface)
        for port, data in (others or {}).items():
            algorithm.SetInputData(port, data)
        for index, (association, array) in (arrays or {}).items():
            algorithm.SetInputArrayToProcess(index, 0, 0, association, array)
        for key, value in {**SETTINGS.get(name, {}), **properties}.items():
            getattr(algorithm, f"Set{key}")(value)
        algorithm.Update()
        messages.raise_errors(f"{name} failed:", model_files.ModelError)
        messages.print_warnings()
        return algorithm

    def style(self, surface, others=None, arrays=None, **properties):
        """The executed vtkThesisStyleFilter."""
        return self.run("vtkThesisStyleFilter", surface, others, arrays, **properties)

    def nonlinear(self, surface, **properties):
        """The executed vtkNonlinearStyleFilter."""
        return self.run("vtkNonlinearStyleFilter", surface, **properties)

    def thesis(self, surface, **properties):
        """The same, exactly as printed in the thesis."""
        return self.style(surface, ReproduceThesis=True, **properties)

    def metrics(self, surface, reference=None, **properties):
        """The row of vtkSurfaceMetrics as {name: number}."""
        others = {} if reference is None else {1: reference}
        table = self.run("vtkSurfaceMetrics", surface, others, **properties).GetOutputDataObject(1)
        return {name: values[0] for name, values in columns(table).items()}


def history(style):
    """The energy table of an executed filter: {column: numbers, one per iteration}."""
    return columns(style.GetOutputDataObject(1))
