"""One picture on many machines: ``specula farm``.

Needs the extra ``farm`` (``pip install "specula-render[farm]"``) to render on Ray; to export jobs
for other schedulers and to simulate a farm, it needs nothing beside the package.
"""
