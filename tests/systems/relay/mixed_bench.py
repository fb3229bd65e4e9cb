"""A relay of four systems in the pump's cell: TRIG takes a pin, MAL and ML carry it on, and a script of 1973 looks
whether the hand still holds it.
"""

from pathlib import Path
from shutil import copy

from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.systems.relay.plan import RelayPlan, made

TEXTS = {
    "go.al": """
        STAGE   "go there"
        OPEN    1
        MOVE    P1UP
        STOP    [0 0 -60]
        CHANGE  [0 0 1] .3
        SKIPE   23
        OPEN    1
""",
    "take.trig": """
>MA PIN
    X -127 Y -38.1 Z 76.2 RECORD
>GRASP
>MR OUT
    Z BY 40 RECORD
>MR ASIDE
    X BY 60 RECORD
>MR LOWER
    Z BY -60 RECORD
>MRG DOWN                        ; it meets the table at last
    Z BY -30 RECORD
    Threshold (oz)? 30
    Force vector (x y z)? (0 0 1)
>SAVPOS STANDS g
>MR UP
    Z BY 20 RECORD
>CN FINISH
""",
    "carry.mal": """10 MOVE Z1 BY - 20
20 MOVE X1 TO STANDSX + 30, Y1 TO STANDSY + 10
30 LIMIT Z1, 15
40 MOVE Z1 BY 10 SLOW 20
50 PINX = POS(X1)
60 PINY = POS(Y1)
70 PINZ = POS(Z1)
80 IF ABS(PINY - STANDSY) > 11 THEN STOP "THE ARM DID NOT GO THERE"
""",
    "lift.ml": """* &1 IS LIFTED
10 CALIB 4
20 SENSOR 4 -1500 1500
30 DMOTOR 2 -400
40 BRANCH 90 50 4
50 GETPOS 1 2
60 PRINT 0
70 STOP
90 PRINT 1
""",
    "still.al": """
        STAGE   "still there"
        CLOSE   .1
        SKIPN   2
        WAIT    "NO PIN"
""",
}
RELAY = """
STAGE "go there"     go.al
STAGE "take the pin" take.trig
STAGE "carry it"     carry.mal
STAGE "lift it"      lift.ml
STAGE "still there"  still.al
"""


def mixed_relay(folder: Path, **changed: str) -> RelayPlan:
    """The plan of the relay, with other texts for the files named `trig`, `mal` or `ml`."""
    for name, text in TEXTS.items():
        (folder / name).write_text(changed.get(name.split(".")[1], text), encoding="utf-8")
    for name in ("go", "still"):
        copy(plans() / "water_pump.toml", folder / f"{name}.toml")
    return made(Source(name="mixed.relay", text=RELAY), folder)
