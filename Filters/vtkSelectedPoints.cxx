// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSelectedPoints.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExtractSelection.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <stdexcept>

namespace
{
void CheckNodes(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    if (node->GetContentType() == vtkSelectionNode::QUERY)
    {
      throw std::invalid_argument(
        "Selection: a query is not understood here; turn it into ids first (in ParaView: Freeze)");
    }
    if (node->GetFieldType() != vtkSelectionNode::POINT &&
      node->GetFieldType() != vtkSelectionNode::CELL)
    {
      throw std::invalid_argument("Selection: it must select points or cells");
    }
  }
}
}

std::vector<char> vtkSelectedPoints(vtkPolyData* input, vtkSelection* selection)
{
  CheckNodes(selection);
  std::vector<char> selected(input->GetNumberOfPoints(), 0);
  if (selection->GetNumberOfNodes() == 0)
  {
    return selected;
  }
  vtkNew<vtkExtractSelection> extract;
  extract->SetInputDataObject(0, input);
  extract->SetInputDataObject(1, selection);
  extract->PreserveTopologyOn();
  extract->Update();
  vtkDataSet* marked = vtkDataSet::SafeDownCast(extract->GetOutputDataObject(0));
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
