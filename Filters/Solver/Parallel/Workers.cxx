// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Workers.h"

#include "Process.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <list>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace SphericalStyle
{
namespace
{
class Job
{
public:
  Job(int count, const std::function<void(int)>& work)
    : Work(work)
  {
    this->Thrown.resize(count);
  }

  /// Does what nobody else has begun.
  void Drain()
  {
    const int count = static_cast<int>(this->Thrown.size());
    for (int k = this->Next++; k < count; k = this->Next++)
    {
      try
      {
        this->Work(k);
      }
      catch (...) // out of a thread it would end the process
      {
        this->Thrown[k] = std::current_exception();
      }
    }
  }

  void Rethrow() const
  {
    for (const std::exception_ptr& exception : this->Thrown)
    {
      if (exception)
      {
        std::rethrow_exception(exception);
      }
    }
  }

  // Guarded by the mutex of Workers.
  int Wanted = 0; // threads that may still join
  int Joined = 0; // threads at work

private:
  std::vector<std::exception_ptr> Thrown; // by work
  const std::function<void(int)>& Work;
  std::atomic<int> Next = 0;
};

class Workers
{
public:
  Workers() = default;
  Workers(const Workers&) = delete;
  void operator=(const Workers&) = delete;

  ~Workers()
  {
    {
      const std::lock_guard lock(this->Mutex);
      this->End = true;
    }
    this->Posted.notify_all();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }

  void Run(Job& job, int others)
  {
    if (this->AreOfAnotherProcess())
    {
      job.Drain();
      return;
    }
    const auto place = this->Post(job, others);
    for (int k = 0; k < others; ++k)
    {
      this->Posted.notify_one();
    }
    job.Drain();
    std::unique_lock lock(this->Mutex);
    if (job.Wanted > 0)
    {
      this->Jobs.erase(place);
    }
    this->Left.wait(lock, [&job] { return job.Joined == 0; });
  }

  /// After a fork the threads, and whoever held the mutex, are with the parent.
  bool AreOfAnotherProcess() const { return this->Process != ProcessId(); }

private:
  std::list<Job*>::iterator Post(Job& job, int others)
  {
    const std::lock_guard lock(this->Mutex);
    try
    {
      while (static_cast<int>(this->Threads.size()) < others)
      {
        this->Threads.emplace_back([this] { this->Serve(); });
      }
    }
    catch (const std::exception&) // no more threads, or no memory for one
    {
    }
    job.Wanted = others;
    return this->Jobs.insert(this->Jobs.end(), &job);
  }

  /// What each of the threads does.
  void Serve()
  {
    std::unique_lock lock(this->Mutex);
    while (true)
    {
      this->Posted.wait(lock, [this] { return this->End || !this->Jobs.empty(); });
      if (this->End)
      {
        return;
      }
      Job& job = *this->Jobs.front();
      ++job.Joined;
      if (--job.Wanted == 0)
      {
        this->Jobs.pop_front();
      }
      lock.unlock();
      job.Drain();
      lock.lock();
      if (--job.Joined == 0)
      {
        this->Left.notify_all();
      }
    }
  }

  const long Process = ProcessId();
  std::mutex Mutex;
  std::condition_variable Posted; // a job, or the end
  std::condition_variable Left;   // the last thread has left a job
  std::list<Job*> Jobs;           // that threads are wanted for, oldest first
  bool End = false;
  std::vector<std::thread> Threads;
};

/// The workers of this process, ended with it or with the library.
class OwnWorkers
{
public:
  OwnWorkers() = default;
  OwnWorkers(const OwnWorkers&) = delete;
  void operator=(const OwnWorkers&) = delete;

  ~OwnWorkers()
  {
    if (this->Own->AreOfAnotherProcess())
    {
      static_cast<void>(this->Own.release()); // joining and destroying would wait for ever
    }
  }

  Workers& operator*() { return *this->Own; }

private:
  std::unique_ptr<Workers> Own = std::make_unique<Workers>();
};
}

void RunOnWorkers(int count, int threads, const std::function<void(int)>& work)
{
  Job job(count, work);
  const int others = std::min(threads, count) - 1;
  if (others > 0)
  {
    static OwnWorkers workers;
    (*workers).Run(job, others);
  }
  else
  {
    job.Drain();
  }
  job.Rethrow();
}
} // namespace SphericalStyle
