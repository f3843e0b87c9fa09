# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's menu and toolbar have every filter, in the order of the table, with an icon.

usage: TestMenu.py PLUGIN_FOLDER MENU.xml
"""
import pathlib
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from FilterTable import FILTERS

MENU = sys.argv.pop()
PLUGIN = pathlib.Path(sys.argv.pop())
CATEGORY = ElementTree.parse(MENU).getroot().find("ParaViewFilters/Category")


class TestMenu(unittest.TestCase):
    def test_order(self):
        names = [entry.get("name") for entry in CATEGORY]
        self.assertEqual(names, list(FILTERS))
        self.assertEqual(names[:1], ["SphericalStyleFilter"])
        self.assertEqual(CATEGORY.get("preserve_order"), "1")

    def test_no_filter_has_a_place_of_its_own(self):
        """With the hint ShowInMenu, ParaView adds a filter before it reads the menu, sorted by name."""
        for name in FILTERS:
            hints = ElementTree.parse(PLUGIN / f"{name}.xml").getroot().iter("ShowInMenu")
            self.assertEqual(list(hints), [], name)

    def test_what_is_for_study_is_not_in_the_toolbar(self):
        self.assertEqual(CATEGORY.get("show_in_toolbar"), "1")
        for entry in CATEGORY:
            study = FILTERS[entry.get("name")]["kind"] == "study"
            self.assertEqual(entry.get("omit_from_toolbar"), "1" if study else "0", entry.get("name"))

    def test_icons(self):
        """A resource that is not there is no icon, without a word."""
        for entry in CATEGORY:
            name = entry.get("name")
            self.assertEqual(entry.get("icon"), f":/SphericalStyle/{name}.svg")
            icon = ElementTree.parse(PLUGIN / "Icons" / f"{name}.svg").getroot()
            self.assertEqual(icon.get("viewBox"), "0 0 24 24", name)


if __name__ == "__main__":
    unittest.main()
