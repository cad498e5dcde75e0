"""Former import name of `actin_filaments`, kept for one release.

This is a module and not a package: if the package `actin` of PyPI is installed too, Python imports that one, and neither
installation overwrites files of the other.
"""

import sys
import warnings

import actin_filaments
from actin_filaments import *  # noqa: F403
from actin_filaments import errors, results

__version__ = actin_filaments.__version__

sys.modules["actin.errors"] = errors
sys.modules["actin.results"] = results
warnings.warn(
    "the package `actin` is now `actin_filaments`: use `import actin_filaments as actin`; this name ends with the next "
    "release",
    DeprecationWarning,
    stacklevel=2,
)
