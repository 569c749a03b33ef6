"""Keywords that tell what they are: the signatures, the help and the errors of functions with options.

A function takes `**keywords`, and `takes` gives it a signature and a documentation with every one of them:
type, default and one sentence, from the library's tables of options. `checked` refuses all others.
"""

from __future__ import annotations

import inspect
import textwrap
from dataclasses import dataclass, replace
from typing import Any, Callable, Mapping, TypeVar, get_args

from ._types import Strategy
from .errors import UnknownOptionError, did_you_mean, refusal
from .options import Option

_Function = TypeVar("_Function", bound=Callable[..., Any])


class Annotation(str):
    """The text of a type, which signatures show without quotes."""

    __repr__ = str.__str__


@dataclass(frozen=True)
class Keyword:
    """A keyword of a function."""

    name: str
    #: Its type, as text.
    type: str
    default: Any
    #: One sentence, or a few.
    text: str


@dataclass(frozen=True)
class Group:
    """Keywords that belong together."""

    heading: str
    keywords: tuple[Keyword, ...]

    def names(self) -> frozenset[str]:
        """The names of the keywords."""
        return frozenset(keyword.name for keyword in self.keywords)

    def but(self, **changed: Mapping[str, Any]) -> Group:
        """The same group with other members of some keywords."""
        fresh = (replace(keyword, **changed.get(keyword.name, {})) for keyword in self.keywords)
        return Group(self.heading, tuple(fresh))

    def without(self, *names: str) -> Group:
        """The same group without some keywords."""
        return Group(self.heading, tuple(k for k in self.keywords if k.name not in names))

    def only(self, *names: str) -> Group:
        """The same group with some keywords alone, in this order."""
        of = {keyword.name: keyword for keyword in self.keywords}
        return Group(self.heading, tuple(of[name] for name in names))


def of_table(table: Mapping[str, Option]) -> tuple[Keyword, ...]:
    """The options of a table of the library as keywords."""
    return tuple(_keyword(option) for option in table.values())


def _keyword(option: Option) -> Keyword:
    text, default, of = option.text, option.default, option.type.__name__
    words = option.range.split("|")
    if option.range == "[0, 1]" and option.type is int:
        of, default = "bool", None if default is None else bool(default)
    elif words == list(get_args(Strategy)):
        of = "Strategy"
    elif len(words) > 1:
        of = f"Literal[{', '.join(repr(option.type(word)) for word in words)}]"
    if default is None:
        of = f"Optional[{of}]"
    text = f"if true, {text[3:]}" if text.startswith("1: ") else text.replace(": 1 if ", ": true if ")
    sentence = f"{text[0].upper()}{text[1:]}.{_told(option, of)}"
    return Keyword(option.name, of, default, sentence)


def _told(option: Option, of: str) -> str:
    """What a range says in words."""
    if "bool" in of:
        return ""
    if "|" in option.range:
        words = [repr(option.type(word)) for word in option.range.split("|")]
        return f" One of {', '.join(words)}."
    least, most = option.range[1:-1].split(", ")
    if most in ("inf", "2147483647", "9007199254740992"):
        return f" Above {least}." if option.range[0] == "(" else f" At least {least}."
    return f" From {least} to {most}."


def takes(*groups: Group) -> Callable[[_Function], _Function]:
    """Gives a function of any keywords the signature and the documentation of these."""

    def told(function: _Function) -> _Function:
        signature = inspect.signature(function)
        given = {p.name: p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD}
        listed = [k for group in groups for k in group.keywords]
        fresh = [given.pop(k.name) if k.name in given else _parameter(k) for k in listed]
        function.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[*given.values(), *fresh]
        )
        lists = "".join(_listed(group) for group in groups)
        function.__doc__ = f"{(function.__doc__ or '').rstrip()}\n{lists}"
        return function

    return told


def _parameter(keyword: Keyword) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(keyword.name, kind, default=keyword.default, annotation=keyword.type)


def _listed(group: Group) -> str:
    lines = [f"\n    {group.heading}:\n"]
    for keyword in group.keywords:
        lines.append(f"      {keyword.name}: {keyword.type} = {keyword.default!r}")
        lines += textwrap.wrap(keyword.text, 100, initial_indent=" " * 10, subsequent_indent=" " * 10)
    return "\n".join(lines) + "\n"


def checked(function: Callable[..., Any], keywords: Mapping[str, Any]) -> dict[str, Any]:
    """The keywords that are given, those that are None left out; an error if the function has not all."""
    known = inspect.signature(function).parameters
    for name in keywords:
        if name not in known:
            told = f"{function.__name__} has no keyword {name!r}"
            question = did_you_mean(name, known)
            raise refusal(UnknownOptionError, f"{told}: {question}" if question else told)
    return {name: value for name, value in keywords.items() if value is not None}


def tidy(thing: Any) -> None:
    """Lets the signatures of a function, or of all functions of a class, show types without quotes."""
    if isinstance(thing, type):
        for name, value in vars(thing).items():
            if inspect.isfunction(value) or isinstance(value, classmethod):
                tidy(getattr(value, "__func__", value))
    elif inspect.isfunction(thing):
        signature = inspect.signature(thing)
        clean = [p.replace(annotation=_clean(p.annotation)) for p in signature.parameters.values()]
        given_back = _clean(signature.return_annotation)
        thing.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=clean, return_annotation=given_back
        )


def _clean(annotation: Any) -> Any:
    return Annotation(annotation) if isinstance(annotation, str) else annotation
