"""Parses expressions and conditions by recursive descent. The operators that bind most weakly are parsed first."""

from typing import Final

from handeye.core.diagnostics import SimilarName, nearest, quoted
from handeye.systems.sigma.mal.codes import mistake
from handeye.systems.sigma.mal.scanner import Token
from handeye.systems.sigma.mal.syntax import Binary, Call, Expression, Number, Unary, Variable
from handeye.systems.sigma.mal.token_reader import Mistaken, TokenReader
from handeye.systems.sigma.mal.words import FUNCTIONS

_RELATIONS: Final = ("=", "<>", "<", ">", "<=", ">=")
_OF_AXES: Final = ("POS", "FORCE", "CRASHPOS", "STATUS")


class ExpressionReader(TokenReader):
    """Parses expressions from the tokens of a line."""

    def _condition(self) -> Expression:
        """Parse a condition, in which OR connects conjunctions, and AND connects relations."""
        self._deeper()
        left = self._conjunction()
        while self._skip("OR"):
            left = Binary("OR", left, self._conjunction())
        self._depth -= 1
        return left

    def _conjunction(self) -> Expression:
        left = self._negation()
        while self._skip("AND"):
            left = Binary("AND", left, self._negation())
        return left

    def _negation(self) -> Expression:
        if self._skip("NOT"):
            self._deeper()
            operand = self._negation()
            self._depth -= 1
            return Unary("NOT", operand)
        return self._relation()

    def _relation(self) -> Expression:
        if self._is("("):  # it encloses a condition, or else an expression
            mark, depth = self._at, self._depth
            self._take()
            try:
                inner = self._condition()
                self._need(")")
                if not (self._is(*_RELATIONS, "+", "-", "*", "/")):
                    return inner
            except Mistaken:
                pass
            self._at, self._depth = mark, depth
        left = self._expression()
        relation = self._need(*_RELATIONS).text
        return Binary(relation, left, self._expression())

    def _expression(self) -> Expression:
        self._deeper()
        left = self._term()
        while self._is("+", "-"):
            operator = self._take().text
            left = Binary(operator, left, self._term())
        self._depth -= 1
        return left

    def _term(self) -> Expression:
        left = self._factor()
        while self._is("*", "/"):
            operator = self._take().text
            left = Binary(operator, left, self._factor())
        return left

    def _factor(self) -> Expression:
        if self._is("-", "+"):
            sign = self._take().text
            self._deeper()
            operand = self._factor()
            self._depth -= 1
            return Unary("-", operand) if sign == "-" else operand
        if self._skip("("):
            inner = self._expression()
            self._need(")")
            return inner
        token = self._next
        if token is None or token.kind not in ("number", "name"):
            self._wrong("a number, a variable or a function")
        if token.kind == "number":
            return Number(float(self._take().text))
        return self._call() if token.text in FUNCTIONS else self._variable()

    def _variable(self) -> Variable:
        name = self._name("the name of a variable")
        if self._is("("):
            told = f"{quoted(name.text)} is not a function, and MAL has no arrays"
            near = nearest(name.text, FUNCTIONS, max(1, len(name.text) // 3))
            raise Mistaken(
                mistake("arrays-dropped", told, name.span, meant=SimilarName(near) if near else None)
            )
        return Variable(name)

    def _call(self) -> Call:
        function = self._take().text
        if function == "TIME":
            return Call(function, None)
        self._need("(")
        argument: Expression | Token = self._axis() if function in _OF_AXES else self._expression()
        self._need(")")
        return Call(function, argument)
