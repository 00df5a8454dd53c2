# How Sphinx builds the manual: scripts/docs.
project = 'yadefrag'
author = 'the yadefrag developers'
extensions = ['myst_parser', 'sphinx.ext.mathjax']
myst_enable_extensions = ['dollarmath', 'deflist']
myst_heading_anchors = 3
exclude_patterns = ['README.md']
html_theme = 'alabaster'
html_theme_options = {'description': 'Contact search and finite-element bodies that fracture, for YADE',
                      'page_width': '1080px', 'fixed_sidebar': True}
html_static_path = []
