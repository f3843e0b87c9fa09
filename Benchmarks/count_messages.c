/* SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Counts the calls of MPI that a process makes, by MPI's profiling interface; VTK's controller uses no others.
 *
 *     mpicc -shared -fPIC -O2 -o count_messages.so Benchmarks/count_messages.c
 *     mpirun -np 4 -x LD_PRELOAD=$PWD/count_messages.so pvbatch --sym Benchmarks/measure_processes.py --repeat 1
 *
 * At the end the first process prints how often it was in each of them. What the program itself does (ParaView's start,
 * sums of the script) counts, too: take the difference of two runs.
 */
#include <mpi.h>
#include <stdio.h>

static struct
{
  long send, receive, broadcast, allReduce, gather, allGather, barrier;
} calls;

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm of)
{
  ++calls.send;
  return PMPI_Send(data, count, type, to, tag, of);
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm of, MPI_Status* status)
{
  ++calls.receive;
  return PMPI_Recv(data, count, type, from, tag, of, status);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int from, MPI_Comm of)
{
  ++calls.broadcast;
  return PMPI_Bcast(data, count, type, from, of);
}

int MPI_Allreduce(const void* own, void* all, int count, MPI_Datatype type, MPI_Op with, MPI_Comm of)
{
  ++calls.allReduce;
  return PMPI_Allreduce(own, all, count, type, with, of);
}

int MPI_Gatherv(const void* own, int count, MPI_Datatype type, void* all, const int* counts, const int* places,
  MPI_Datatype typeOfAll, int at, MPI_Comm of)
{
  ++calls.gather;
  return PMPI_Gatherv(own, count, type, all, counts, places, typeOfAll, at, of);
}

int MPI_Allgather(
  const void* own, int count, MPI_Datatype type, void* all, int countOfAll, MPI_Datatype typeOfAll, MPI_Comm of)
{
  ++calls.allGather;
  return PMPI_Allgather(own, count, type, all, countOfAll, typeOfAll, of);
}

int MPI_Barrier(MPI_Comm of)
{
  ++calls.barrier;
  return PMPI_Barrier(of);
}

int MPI_Finalize(void)
{
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
  {
    printf("send %ld, receive %ld, broadcast %ld, all-reduce %ld, gather %ld, all-gather %ld, barrier %ld\n", calls.send,
      calls.receive, calls.broadcast, calls.allReduce, calls.gather, calls.allGather, calls.barrier);
  }
  return PMPI_Finalize();
}
