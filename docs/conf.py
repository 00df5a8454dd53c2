# How Sphinx builds the manual: scripts/docs.
project = 'yadefrag'
author = 'the yadefrag developers'
html_title = 'yadefrag'
extensions = ['myst_parser', 'sphinx_copybutton']
myst_enable_extensions = ['deflist']
myst_heading_anchors = 4
html_theme = 'furo'
html_static_path = ['static']
html_css_files = ['manual.css']
