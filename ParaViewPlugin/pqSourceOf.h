// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the window has for the filter of a panel.
#ifndef pqSourceOf_h
#define pqSourceOf_h

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"

/// The pipeline source of a proxy, or nullptr.
inline pqPipelineSource* pqSourceOf(vtkSMProxy* proxy)
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(proxy);
}

/// The same, but nullptr where Apply was never pressed: then nothing must be executed, not even for
/// a picture.
inline pqPipelineSource* pqExecutedSourceOf(vtkSMProxy* proxy)
{
  pqPipelineSource* source = pqSourceOf(proxy);
  return source && source->modifiedState() != pqProxy::UNINITIALIZED ? source : nullptr;
}

#endif
