// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Checks of a filter's properties by their names. Where they are used there are a `check`, a
/// `filter` and its class as FilterType.
#ifndef PropertyTesting_h
#define PropertyTesting_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>

/// What the object warns of while `set` runs.
template <typename Set>
std::string WarningOf(vtkObject* object, const Set& set)
{
  std::string said;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&said);
  note->SetCallback([](vtkObject*, unsigned long, void* into, void* text)
    { *static_cast<std::string*>(into) += static_cast<const char*>(text); });
  const unsigned long tag = object->AddObserver(vtkCommand::WarningEvent, note);
  set();
  object->RemoveObserver(tag);
  return said;
}

// Sets a value that is not the default, then the default again.
#define RoundTrip(Name, initial, other)                                                            \
  check(filter->Get##Name() == (initial), #Name " should start as " #initial);                     \
  {                                                                                                \
    const vtkMTimeType time = filter->GetMTime();                                                  \
    filter->Set##Name(other);                                                                      \
    check(filter->Get##Name() == (other), #Name " should be " #other " after setting it");         \
    check(filter->GetMTime() > time, #Name " should modify the filter");                           \
  }                                                                                                \
  filter->Set##Name(initial)
#define OnOff(Name, initial)                                                                       \
  RoundTrip(Name, initial, !(initial));                                                            \
  filter->Name##On();                                                                              \
  check(filter->Get##Name(), #Name "On should switch it on");                                      \
  filter->Name##Off();                                                                             \
  check(!filter->Get##Name(), #Name "Off should switch it off");                                   \
  filter->Set##Name(initial)
#define Mode(Name, value, Enumerator, number)                                                      \
  filter->Set##Name##To##value();                                                                  \
  check(filter->Get##Name() == FilterType::Enumerator && FilterType::Enumerator == (number),       \
    "Set" #Name "To" #value " should be " #number)
// Not in silence, but once, with the name; a value in the range is no reason for a word.
#define Clamped(Name, value, result)                                                               \
  {                                                                                                \
    const auto old = filter->Get##Name();                                                          \
    const std::string said = WarningOf(filter.Get(), [&] { filter->Set##Name(value); });           \
    check(filter->Get##Name() == (result), #Name " set to " #value " should be " #result);         \
    check(said.find(#Name " must be from ") != std::string::npos &&                                \
        said.find("must") == said.rfind("must"),                                                   \
      #Name " set to " #value " should be a warning, and not '" + said + "'");                     \
    check(                                                                                         \
      WarningOf(filter.Get(), [&] { filter->Set##Name(old); }).empty(), #Name " in its range");    \
  }

#endif
