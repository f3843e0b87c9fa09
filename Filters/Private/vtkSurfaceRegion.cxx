// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceRegion.h"

#include "Parallel.h"
#include "RegionBorder.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExtractSelection.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;

namespace
{
/// Whether the list is what its content asks for. vtkExtractSelection would select nothing over
/// a wrong shape, and end the process over what is no numbers.
bool HasGoodList(vtkSelectionNode* node)
{
  vtkAbstractArray* list = node->GetSelectionList();
  const bool numbers = vtkDataArray::SafeDownCast(list) != nullptr;
  switch (node->GetContentType())
  {
    case vtkSelectionNode::LOCATIONS:
      return numbers && list->GetNumberOfComponents() == 3;
    case vtkSelectionNode::FRUSTUM:
      return numbers && list->GetNumberOfValues() == 32; // eight corners
    case vtkSelectionNode::THRESHOLDS:
      return numbers && list->GetNumberOfValues() % 2 == 0;
    case vtkSelectionNode::BLOCKS:
      return numbers;
    case vtkSelectionNode::GLOBALIDS:
    case vtkSelectionNode::PEDIGREEIDS:
    case vtkSelectionNode::VALUES:
    case vtkSelectionNode::INDICES:
      return numbers || !list;
    default:
      return true;
  }
}

/// Whether the list is compared with an array of the input, which vtkExtractSelection takes to be
/// of full length.
bool ComparesWithArray(int content)
{
  return content == vtkSelectionNode::GLOBALIDS || content == vtkSelectionNode::PEDIGREEIDS ||
    content == vtkSelectionNode::VALUES || content == vtkSelectionNode::THRESHOLDS;
}

void CheckNodes(vtkPolyData* input, vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    if (node->GetContentType() == vtkSelectionNode::QUERY)
    {
      throw std::invalid_argument(
        "Selection: a query is not understood here; turn it into ids first (in ParaView: Freeze)");
    }
    const int content = node->GetContentType();
    if (content < 0 || content >= vtkSelectionNode::USER)
    {
      // vtkExtractSelection would end the process.
      throw std::invalid_argument(
        "Selection: content type " + std::to_string(content) + " is not understood here");
    }
    if (!HasGoodList(node))
    {
      throw std::invalid_argument(std::string("Selection: the list of ") +
        vtkSelectionNode::GetContentTypeAsString(content) +
        " must be numbers: with 3 components (locations), 32 of them (a frustum), or pairs "
        "(thresholds)");
    }
    if (ComparesWithArray(content))
    {
      vtkSurfaceMeshConversion::CheckArrays(input);
    }
    if (node->GetFieldType() != vtkSelectionNode::POINT &&
      node->GetFieldType() != vtkSelectionNode::CELL)
    {
      throw std::invalid_argument("Selection: it must select points or cells");
    }
  }
}

/// Of data that has one: see InTree. nullptr if that is left out.
vtkDataSet* OnlySurface(vtkDataObject* data)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return vtkDataSet::SafeDownCast(data);
  }
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  leaves->InitTraversal();
  return leaves->IsDoneWithTraversal() ? nullptr
                                       : vtkDataSet::SafeDownCast(leaves->GetCurrentDataObject());
}

/// Diagonal of the bounds.
double Diagonal(const Points& P)
{
  return (0.5 * P.colwise().maxCoeff() - 0.5 * P.colwise().minCoeff()).stableNorm() * 2.0;
}

/// Distance of each point inside to the nearest one outside; 0 outside.
Eigen::VectorXd DistancesToOutside(const Points& P, const std::vector<char>& inside, int threads)
{
  const Eigen::Index n = P.rows();
  Eigen::VectorXd distances = Eigen::VectorXd::Zero(n);
  // At size 1: the locator does not work at every scale.
  const Eigen::RowVector3d low = P.colwise().minCoeff();
  const double scale = Diagonal(P);
  const auto place = [&](Eigen::Index i) -> Eigen::Vector3d
  { return scale > 0.0 ? (P.row(i) - low) / scale : Eigen::RowVector3d::Zero().eval(); };
  std::vector<Eigen::Index> outsideIds;
  vtkNew<vtkPoints> outside;
  outside->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    if (!inside[i])
    {
      outsideIds.push_back(i);
      outside->InsertNextPoint(place(i).data());
    }
  }
  if (outsideIds.empty())
  {
    return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(outside);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator(); // before the threads ask
  SphericalStyle::ParallelFor(static_cast<int>(n), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        if (inside[i])
        {
          const vtkIdType nearest = locator->FindClosestPoint(place(i).data());
          distances[i] = (P.row(i) - P.row(outsideIds[nearest])).stableNorm();
        }
      }
    });
  return distances;
}
}

std::vector<char> vtkSurfaceRegion::SelectedPoints(
  vtkAlgorithm* self, vtkPolyData* input, vtkSelection* selection)
{
  CheckNodes(input, selection);
  std::vector<char> selected(input->GetNumberOfPoints(), 0);
  if (selection->GetNumberOfNodes() == 0)
  {
    return selected;
  }
  vtkNew<vtkExtractSelection> extract;
  extract->SetInputDataObject(0, vtkFilterSupport::InTree(self, input));
  extract->SetInputDataObject(1, selection);
  extract->PreserveTopologyOn();
  extract->Update();
  vtkDataSet* marked = OnlySurface(extract->GetOutputDataObject(0));
  if (!marked)
  {
    return selected;
  }
  if (vtkDataArray* points = marked->GetPointData()->GetArray("vtkInsidedness"))
  {
    for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
    {
      selected[i] = points->GetComponent(i, 0) > 0.0;
    }
  }
  if (vtkDataArray* cells = marked->GetCellData()->GetArray("vtkInsidedness"))
  {
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < cells->GetNumberOfTuples(); ++c)
    {
      if (cells->GetComponent(c, 0) > 0.0)
      {
        marked->GetCellPoints(c, ids);
        for (const vtkIdType i : *ids)
        {
          selected[i] = 1;
        }
      }
    }
  }
  return selected;
}

std::vector<char> vtkSurfaceRegion::Marks(vtkAlgorithm* self, vtkInformation* mask,
  vtkSelection* selection, vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  const Points values = vtkSurfaceMeshConversion::GatherPointArray(mask, input, surface,
    { "Region", 1, -std::numeric_limits<double>::infinity(),
      std::numeric_limits<double>::infinity() });
  if (values.rows() == 0 && !selection)
  {
    return {};
  }
  std::vector<char> region(surface.Mesh.P.rows(), 1);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    region[i] = values(i, 0) != 0.0;
  }
  if (selection)
  {
    const std::vector<char> selected = SelectedPoints(self, input, selection);
    std::vector<char> chosen(region.size(), 0);
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      if (surface.MeshPoint[i] != vtkSurfaceMesh::NotMoved)
      {
        chosen[surface.MeshPoint[i]] |= selected[i];
      }
    }
    std::transform(region.begin(), region.end(), chosen.begin(), region.begin(),
      [](char a, char b) { return static_cast<char>(a & b); });
  }
  return region;
}

Eigen::VectorXd vtkSurfaceRegion::Weights(
  const Points& P, const std::vector<char>& inside, double width, int threads)
{
  if (P.rows() == 0)
  {
    return {};
  }
  return SphericalStyle::BorderWeights(DistancesToOutside(P, inside, threads), width * Diagonal(P));
}
