"""Packs this folder as a .vsix, which VS Code installs; needs nothing but Python.

$ python editors/vscode/make_vsix.py            # writes handeye-armal-0.1.0.vsix into the current folder
$ code --install-extension handeye-armal-0.1.0.vsix

A .vsix is a zip with the extension's files in `extension/`, a manifest made from package.json, and a list of the types
of its files. Equal folders give equal bytes.
"""

import json
import sys
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

FOLDER = Path(__file__).resolve().parent
FILES = (
    "package.json", "README.md", "extension.js", "client.js", "language-configuration.json",
    "syntaxes/armal.tmLanguage.json",
)  # fmt: skip
TYPES = {
    ".json": "application/json",
    ".js": "application/javascript",
    ".md": "text/markdown",
    ".vsixmanifest": "text/xml",
}
MANIFEST = """<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id={name} Version={version} Publisher={publisher} />
    <DisplayName>{title}</DisplayName>
    <Description xml:space="preserve">{description}</Description>
    <Categories>{categories}</Categories>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value={engine} />
    </Properties>
  </Metadata>
  <Installation>
    <InstallationTarget Id="Microsoft.VisualStudio.Code" />
  </Installation>
  <Dependencies />
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true" />
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true" />
  </Assets>
</PackageManifest>
"""


def packed(path: Path) -> None:
    """Write the package."""
    about = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
    manifest = MANIFEST.format(
        **{name: quoteattr(about[name]) for name in ("name", "version", "publisher")},
        title=escape(about["displayName"]),
        description=escape(about["description"]),
        categories=escape(",".join(about["categories"])),
        engine=quoteattr(about["engines"]["vscode"]),
    )
    types = "".join(f'<Default Extension="{end[1:]}" ContentType="{kind}" />' for end, kind in TYPES.items())
    content = f'<?xml version="1.0" encoding="utf-8"?>\n<Types xmlns="{CONTENT}">{types}</Types>\n'
    with ZipFile(path, "w", ZIP_DEFLATED) as package:
        for name, text in (("extension.vsixmanifest", manifest), ("[Content_Types].xml", content)):
            package.writestr(_entry(name), text)
        for name in FILES:
            package.writestr(_entry(f"extension/{name}"), (FOLDER / name).read_bytes())


CONTENT = "http://schemas.openxmlformats.org/package/2006/content-types"


def _entry(name: str) -> ZipInfo:
    entry = ZipInfo(name)  # dated 1980, so that equal folders give equal packages
    entry.compress_type = ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    return entry


def main(words: list[str]) -> int:
    """Write the package to the given file, by default in the current folder."""
    about = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
    path = Path(words[0]) if words else Path(f"{about['name']}-{about['version']}.vsix")
    packed(path)
    sys.stdout.write(f"{path}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
