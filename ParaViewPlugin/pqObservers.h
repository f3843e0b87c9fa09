// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Observers of VTK's objects that end with their owner, a widget that has this as a member. What
/// is observed is kept alive, since properties can outlast their panel and the other way round.
#ifndef pqObservers_h
#define pqObservers_h

#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

class pqObservers
{
public:
  pqObservers() = default;
  pqObservers(const pqObservers&) = delete;
  pqObservers& operator=(const pqObservers&) = delete;
  ~pqObservers() { this->clear(); }

  template <class Owner>
  void add(vtkObject* observed, unsigned long event, Owner* owner, void (Owner::*function)())
  {
    this->Tags.emplace_back(observed, observed->AddObserver(event, owner, function));
  }

  /// The same for a function that wants to know more of the event.
  template <class Owner>
  void add(vtkObject* observed, unsigned long event, Owner* owner,
    void (Owner::*function)(vtkObject*, unsigned long, void*))
  {
    this->Tags.emplace_back(observed, observed->AddObserver(event, owner, function));
  }

  void clear()
  {
    for (const auto& [observed, tag] : this->Tags)
    {
      observed->RemoveObserver(tag);
    }
    this->Tags.clear();
  }

private:
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> Tags;
};

#endif
