"""Sphinx configuration. Run with PYTHONPATH=build/release/python:

python3 -m sphinx -W -b html scenes/api/python/docs build/pages/python
"""

import raylane

project = "raylane"
version = release = raylane.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.viewcode"]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}
python_use_unqualified_type_names = True
html_theme = "alabaster"
html_theme_options = {"page_width": "60em", "description": "Quadrics, traced exactly"}
