"""Addresses: from a place to the array, and to the text of the subscript."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from iec2mpy.backends.forms import Text, infix, number
from iec2mpy.backends.layout import NOWHERE, Layout, Size
from iec2mpy.backends.names import SlotNames
from iec2mpy.ir import nodes as n
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou

WriteExpr = Callable[[n.Expr], Text]


@dataclass(slots=True)
class Addresses:
    """Writes addresses for one body. `pou` is the POU whose body it is; its base parameters are `b` (V) and `p` (O)."""

    layout: Layout
    names: SlotNames
    pou: Pou
    write: WriteExpr

    def subscript(self, place: n.Place, array: str) -> Text:
        """The number of the slot where the place begins, in V or in O."""
        position, path, dynamic = self._position(place, array)
        if path and array == "O" and self.layout.size_of(place.type).v:
            # the same variable has another position in V
            path = (*path, "O")
        dynamic = [text for text in dynamic if text.code != "0"]
        if position or not dynamic:
            named = Text(self.names.name(path, position, self._comment(place))) if path else number(position)
            dynamic = (
                [*dynamic[:1], named, *dynamic[1:]]
                if dynamic[:1] and dynamic[0].code in ("b", "p")
                else [named, *dynamic]
            )
        text = dynamic[0]
        for term in dynamic[1:]:
            text = infix(text, "+", term)
        return text

    def reference(self, place: n.Place) -> Text:
        """The one slot's worth of a reference to the place: V in the low 16 bits, O above."""
        if isinstance(place.root, n.Deref) and not place.steps:
            return self.write(place.root.reference)
        size = self.layout.size_of(place.type)
        if not size.o:
            return self.subscript(place, "V")
        above = infix(self.subscript(place, "O"), "<<", number(16))
        return infix(self.subscript(place, "V"), "|", above) if size.v else above

    # ------------------------------------------------------------------------------------ parts

    def _position(self, place: n.Place, array: str) -> tuple[int, tuple[str, ...], list[Text]]:
        """The fixed part with its name, and what is added to it at run time."""
        position, path, dynamic = self._root(place.root, array)
        declared = _root_type(place.root)
        for step in place.steps:
            if isinstance(step, n.Field):
                offset = self._offset(place.root, declared, step)
                position += offset.of(array)
                path = (*path, step.variable.name)
                declared = step.variable.type
            else:
                unaliased = ty.unaliased(declared) if declared is not None else None
                assert isinstance(unaliased, (ty.ArrayType, ty.OpenArrayType))
                stride = self.layout.size_of(unaliased.element).of(array)
                declared = unaliased.element
                constant, terms = _scaled(step.index, stride)
                position += constant
                if constant:
                    path = (*path, str(constant))
                dynamic = [*dynamic, *(self._term(term, factor) for term, factor in terms)]
        return position, path, dynamic

    def _root(self, root: n.Root, array: str) -> tuple[int, tuple[str, ...], list[Text]]:
        match root:
            case n.Global(variable):
                return self.layout.global_position(variable).of(array), (variable.name,), []
            case n.Frame(pou):
                return self.layout.frames[pou].of(array), (pou.name,), []
            case n.Self(pou):
                base = self.layout.single_base(pou)
                if base is not None:
                    return base.of(array), (pou.name,), []
                assert pou is self.pou, "only its own body knows an instance by its base"
                return 0, (pou.name,), [Text("b" if array == "V" else "p")]
            case n.Deref(reference, declared):
                return 0, (), [self._referred(self.write(reference), declared, array)]

    def _referred(self, reference: Text, declared: ty.Type, array: str) -> Text:
        if array == "O":
            return infix(reference, ">>", number(16))
        return infix(reference, "&", number(0xFFFF)) if self.layout.size_of(declared).o else reference

    def _offset(self, root: n.Root, declared: ty.Type | None, step: n.Field) -> Size:
        if declared is None:
            if isinstance(root, n.Global):
                return NOWHERE
            if isinstance(root, n.Frame):
                return self.layout.frame_record(root.pou).offsets[step.variable]
            assert isinstance(root, n.Self)
            return self.layout.instance_record(root.pou).offsets[step.variable]
        declared = ty.unaliased(declared)
        assert isinstance(declared, (ty.StructType, ty.BlockType))
        return self.layout.record(declared).offsets[step.variable]

    def _term(self, term: n.Expr, factor: int) -> Text:
        text = self.write(term)
        return text if factor == 1 else infix(text, "*", number(factor))

    def _comment(self, place: n.Place) -> str:
        """What a constant stands for: the declaration of the last variable of a plain path."""
        fields = [step.variable for step in place.steps if isinstance(step, n.Field)]
        root = [place.root.variable] if isinstance(place.root, n.Global) else []
        variable = next(reversed([*root, *fields]), None)
        if variable is None:
            return ""
        located = f" ({variable.address})" if variable.address else ""
        return f"{variable.span.file.name}:{variable.span.line} {variable.name} : {variable.type}{located}"


def _root_type(root: n.Root) -> ty.Type | None:
    """The type that the first step selects from; None where it selects from a frame or an instance of a program."""
    match root:
        case n.Global(variable):
            return variable.type
        case n.Deref(_, declared):
            return declared
        case _:
            return None


def _scaled(index: n.Expr, stride: int) -> tuple[int, list[tuple[n.Expr, int]]]:
    """The index times the stride, as a constant and terms."""
    match index:
        case n.Const():
            return index.number * stride, []
        case n.Op("add", left, right):
            (constant1, terms1), (constant2, terms2) = _scaled(left, stride), _scaled(right, stride)
            return constant1 + constant2, terms1 + terms2
        case n.Op("mul", left, n.Const() as factor):
            return _scaled(left, stride * factor.number)
        case _:
            return 0, [(index, stride)]
