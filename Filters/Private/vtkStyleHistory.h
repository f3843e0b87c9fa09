// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a filter tells of the iteration of a style: the table of its energy. Private.
#ifndef vtkStyleHistory_h
#define vtkStyleHistory_h

#include "MirrorPlane.h"
#include "StyleSolver.h" // for StyleReport

#include <optional>
#include <string>
#include <vector>

class vtkTable;

namespace vtkStyleHistory
{
/// The history as rows; how long each stage took, what solved the system and the spheres (center
/// and radius) as field data.
/// @param secondTerm  name of the column of the term beside the rigid one; nullptr where there is
/// none
void Fill(vtkTable* table, const SphericalStyle::StyleReport& report, const char* secondTerm);

/// The advice as field data.
void AddAdvice(vtkTable* table, const char* advice);

/// The plane of symmetry as field data: a point of it and the normal; nothing without.
void AddPlane(vtkTable* table, const std::optional<SphericalStyle::MirrorPlane>& plane);

/// What the processes of a surface that is spread have sent and received, as field data; nothing
/// without.
/// @param bytes  two numbers a process
void AddBytes(vtkTable* table, const std::vector<double>& bytes);

/// The warnings of an iteration: a loop that ended without meeting its stop rule, and solves of the
/// global step that ended before their solution.
std::vector<std::string> Remarks(const SphericalStyle::StyleReport& report);
}

#endif
