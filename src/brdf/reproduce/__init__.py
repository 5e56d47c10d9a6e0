"""The results of the source documents, made again: one module a document, our numbers beside theirs."""

from ..callable_module import make_callable
from .report import Column, Panel, Report
from .run import names, reproduce, title

__all__ = ["Column", "Panel", "Report", "names", "reproduce", "title"]

make_callable(__name__, reproduce)
