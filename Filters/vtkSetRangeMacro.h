// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSetClampMacro with a word: a value outside of the range is set to the nearest one inside, and
 * a warning names the property, the range and the value. Without it a script goes on with another
 * value than it has asked for, and nobody says so. NaN passes, and is refused when the filter runs.
 */
#ifndef vtkSetRangeMacro_h
#define vtkSetRangeMacro_h

#include "vtkObject.h" // for vtkWarningMacro
#include "vtkSetGet.h" // for vtkDebugMacro

#define vtkSetRangeMacro(name, type, least, greatest)                                              \
  virtual void Set##name(type _arg)                                                                \
  {                                                                                                \
    vtkDebugMacro(<< " setting " #name " to " << _arg);                                            \
    if (_arg < (least) || _arg > (greatest))                                                       \
    {                                                                                              \
      const type nearest = _arg < (least) ? (least) : (greatest);                                  \
      vtkWarningMacro(<< #name " must be from " << (least) << " to " << (greatest) << "; it is "   \
                      << _arg << ", and " << nearest << " is taken");                              \
      _arg = nearest;                                                                              \
    }                                                                                              \
    if (this->name != _arg)                                                                        \
    {                                                                                              \
      this->name = _arg;                                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue()                                                               \
  {                                                                                                \
    return least;                                                                                  \
  }                                                                                                \
  virtual type Get##name##MaxValue()                                                               \
  {                                                                                                \
    return greatest;                                                                               \
  }

#endif
