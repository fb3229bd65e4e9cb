; What the pump of four languages needs of camera and touch, for the relay four_languages.relay: TRIG, ML and MAL have no words
; for CENTER and for pictures. The positions are those of water_pump.al.

        STAGE   "find the pin holder"
        OPEN    1.3
        MOVE    P1
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 1 IS NOT IN ITS HOLDER: IT IS MISSING, OR THE HOLDER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  0 .35           ;as far as arm and holder are off together at twice their errors
        SKIPN   8
        WAIT    "THE HOLDER OF PIN 1 IS NOT WHERE IT SHOULD BE: IT HAS MOVED, OR A JOINT READS WRONG"
        SAVE    C1              ;where the holder really is
        OPEN    1.3
        MOVE    P2
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 2 IS NOT IN ITS HOLDER: IT IS MISSING, OR THE HOLDER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  0 .35
        SKIPN   8
        WAIT    "THE HOLDER OF PIN 2 IS NOT WHERE IT SHOULD BE: IT HAS MOVED, OR A JOINT READS WRONG"
        SAVE    C2
        OPEN    1.3
        CHANGE  [0 0 1] 1.5

        STAGE   "find the pins"
        OPEN    1
        MOVE    Q1
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 1 DOES NOT STAND IN THE BASE"
        SAVE    Y1              ;where its hole is, across the line of centres
        OPEN    1
        CHANGE  [0 0 1] 1.5
        MOVE    Q2
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 2 DOES NOT STAND IN THE BASE"
        SAVE    X2              ;and along it
        OPEN    1
        CHANGE  [0 0 1] 1.5
        OPEN    1.2
        MOVE    Q2Y
        RESTORE X2
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 2 DOES NOT STAND IN THE BASE"
        SAVE    Y2              ;and across it: the base may be turned
        OPEN    1.2
        CHANGE  [0 0 1] 1.5
        MOVE    FACE            ;over the web of the base
        RESTORE Y1
        RESTORE X2
        OPEN    0
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1  ;slowly: .002 in a servo period
        SAVE    BARE            ;how high its face is
        CHANGE  [0 0 1] 1

        STAGE   "look at the base"
        LENS    50
        AIM     PUMP
        OPEN    0
        PARK
        LOOK    BEFORE

        STAGE   "check the gasket"
        ASSIGN  TRIES 2
        OPEN    0
        PARK
AGAIN:  LOOK    AFTER HOLD
        INSPECT PUMP BEFORE AFTER
        SKIPE   32
        JUMP    RIGHT
        SOJG    TRIES AGAIN
        WAIT    "THE GASKET IS NOT ON PROPERLY, OR THE CAMERA OR THE LIGHT HAS CHANGED"
RIGHT:  CHANGE  [0 0 1] .1
