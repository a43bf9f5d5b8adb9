# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the gallery, each a link to the script that makes it.

    .. gallery-picture:: images/NAME.png
       :script: scripts/tutorials/NAME.py
       :alt: What can be seen

       Caption.

The path of the script starts at the root of the project. A click on the picture downloads it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from sphinx import addnodes

ROOT = Path(__file__).resolve().parents[2]


class GalleryPicture(Directive):
    """A picture with its caption, linked to its script."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar[dict[str, Any]] = {
        "script": directives.unchanged_required,
        "alt": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        """Return the picture, its caption and the name of the script."""
        script = self.options["script"]
        if not (ROOT / script).is_file():
            raise self.error(f"gallery-picture: script = {script}, is not a file")
        picture = nodes.image(uri=self.arguments[0], alt=self.options["alt"])
        caption = nodes.container(classes=["gallery-caption"])
        self.state.nested_parse(self.content, self.content_offset, caption)
        name = nodes.paragraph("", "", self._link(script, nodes.literal("", Path(script).name)))
        linked = nodes.paragraph("", "", self._link(script, picture))
        return [nodes.container("", linked, caption, name, classes=["gallery-picture"])]

    @staticmethod
    def _link(script: str, shown: nodes.Node) -> nodes.Node:
        return addnodes.download_reference("", "", shown, refdoc="", reftarget=f"/../{script}")


def setup(app: Any) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("gallery-picture", GalleryPicture)
    return {"parallel_read_safe": True}
