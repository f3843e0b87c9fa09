# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A VTK that nothing was built for."""


class vtkVersion:
    @staticmethod
    def GetVTKVersion():
        return "8.90.0"
