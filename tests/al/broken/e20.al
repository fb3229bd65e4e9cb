; is anything on the table here?
        TRANS   SPOT [28 37 5 90 90 0]
        OPEN    .2
        MOVE    SPOT
        CHANGE  [0 0 -1] 1.5
        STOP    [0 0 -30]
        SKIPN   23
        JUMP    EMPTY
        WHERE
        WAIT    "there is something in the way"
EMPTY:  PARK
