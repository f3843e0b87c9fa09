// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkProcesses.h"

#include "vtkFilterSupport.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <exception>
#include <numeric>

namespace
{
constexpr int PartOfSum = 73103; // a tag that nobody else sends with at the same time

double Bytes(std::size_t numbers)
{
  return static_cast<double>(numbers * sizeof(double));
}
}

vtkProcesses::vtkProcesses(vtkMultiProcessController* controller)
  : Controller(controller)
{
}

int vtkProcesses::GetRank() const
{
  return this->Controller->GetLocalProcessId();
}

/// Says whether this process has failed, and hears of the others.
void vtkProcesses::GoOn(int failed) const
{
  int any = 0;
  this->Controller->AllReduce(&failed, &any, 1, vtkCommunicator::MAX_OP);
  if (any != 0)
  {
    throw SphericalStyle::OtherProcessFailed();
  }
}

bool vtkProcesses::Run(
  const std::function<void()>& execute, bool hasPoints, std::string& failure) const
{
  failure.clear();
  try
  {
    try
    {
      execute();
    }
    catch (const SphericalStyle::OtherProcessFailed&)
    {
      throw;
    }
    catch (const SphericalStyle::WholeSurfaceNeeded&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      failure = vtkFilterSupport::WordsOf(error);
    }
    this->GoOn(failure.empty() ? 0 : 1);
    return true;
  }
  catch (const SphericalStyle::OtherProcessFailed&)
  {
  }
  const std::vector<double> all =
    this->Concatenate({ failure.empty() ? 0.0 : 1.0, hasPoints ? 1.0 : 0.0 });
  int first = -1;
  bool alike = true;
  for (std::size_t k = 0; k < all.size(); k += 2)
  {
    first = first < 0 && all[k] > 0.0 ? static_cast<int>(k / 2) : first;
    alike &= all[k] > 0.0 || all[k + 1] == 0.0;
  }
  if (alike && this->GetRank() != first)
  {
    failure.clear();
  }
  else if (!alike && !failure.empty())
  {
    failure = "process " + std::to_string(this->GetRank()) + ": " + failure;
  }
  return false;
}

bool vtkProcesses::AreAlike(const std::vector<double>& own) const
{
  const std::vector<double> all = this->Concatenate(own);
  bool alike = true;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    alike &= all[i] == own[i % own.size()];
  }
  return alike;
}

std::vector<double> vtkProcesses::GetBytesOfAll() const
{
  const std::vector<double> own = { this->BytesSent, this->BytesReceived };
  this->BytesSent = 0.0;
  this->BytesReceived = 0.0;
  return this->Concatenate(own);
}

/// From the first process to all.
void vtkProcesses::Broadcast(double* numbers, vtkIdType size) const
{
  this->Controller->Broadcast(numbers, size, 0);
  (this->GetRank() == 0 ? this->BytesSent : this->BytesReceived) += Bytes(size);
}

void vtkProcesses::Reduce(double* numbers, std::size_t size, const Join& join) const
{
  std::vector<double> received(size); // before others wait for this process
  this->GoOn();
  if (size == 0)
  {
    return;
  }
  const int rank = this->GetRank();
  const int count = this->Controller->GetNumberOfProcesses();
  const auto length = static_cast<vtkIdType>(size);
  for (int step = 1; step < count; step *= 2)
  {
    if (rank % (2 * step) != 0)
    {
      this->Controller->Send(numbers, length, rank - step, PartOfSum);
      this->BytesSent += Bytes(size);
      break;
    }
    if (rank + step < count)
    {
      this->Controller->Receive(received.data(), length, rank + step, PartOfSum);
      this->BytesReceived += Bytes(size);
      join(numbers, received.data());
    }
  }
  this->Broadcast(numbers, length);
}

std::vector<double> vtkProcesses::Concatenate(const std::vector<double>& own) const
{
  const int count = this->Controller->GetNumberOfProcesses();
  const auto size = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> sizes(count);
  std::vector<vtkIdType> offsets(count + 1, 0);
  this->GoOn();
  this->Controller->AllGather(&size, sizes.data(), 1);
  std::partial_sum(sizes.begin(), sizes.end(), offsets.begin() + 1);
  std::vector<double> all(offsets.back());
  if (all.empty())
  {
    return all;
  }
  this->GoOn(); // that there is memory for all of it, everywhere
  this->Controller->GatherV(own.data(), all.data(), size, sizes.data(), offsets.data(), 0);
  if (this->GetRank() == 0)
  {
    this->BytesReceived += Bytes(all.size() - own.size());
  }
  else
  {
    this->BytesSent += Bytes(own.size());
  }
  this->Broadcast(all.data(), offsets.back());
  return all;
}
