# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 4: the linear spherical feature, by sections. Importing them registers their experiments."""
import chapter4_directions  # noqa: F401
import chapter4_method  # noqa: F401
import chapter4_normals  # noqa: F401
