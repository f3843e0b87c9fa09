// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The processes of a controller, as the solver talks to them. Private.
#ifndef vtkProcesses_h
#define vtkProcesses_h

#include "Processes.h"
#include "vtkType.h" // for vtkIdType

#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

/// Every call begins with a message of one number that says whether some process has failed, so
/// that none waits for one that has.
class vtkProcesses : public SphericalStyle::Processes
{
public:
  /// @param controller  must outlive this
  explicit vtkProcesses(vtkMultiProcessController* controller);

  int GetRank() const override;
  void Reduce(double* numbers, std::size_t size, const Join& join) const override;
  std::vector<double> Concatenate(const std::vector<double>& own) const override;

  bool IsOf(vtkMultiProcessController* controller) const { return this->Controller == controller; }

  /// Whether these numbers are the same on all processes.
  bool AreAlike(const std::vector<double>& own) const;

  /// Runs `execute` on all processes to its end, or on none.
  /// @param hasPoints  whether this process has a part of the surface
  /// @param failure  empty, or what this process is to tell: of a fault that all processes with
  /// points have alike the first of them tells
  /// @return whether it was done @throw WholeSurfaceNeeded on all processes
  bool Run(const std::function<void()>& execute, bool hasPoints, std::string& failure) const;

  /// Bytes that each process has sent since the last call, and bytes that it has received: two
  /// numbers a process.
  std::vector<double> GetBytesOfAll() const;

private:
  void GoOn(int failed = 0) const;
  void Broadcast(double* numbers, vtkIdType size) const;

  vtkMultiProcessController* Controller;
  mutable double BytesSent = 0.0;
  mutable double BytesReceived = 0.0;
};

#endif
