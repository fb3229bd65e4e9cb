        TRANS   PEG [18 40 3 90 90 0]
        OPEN    1
        MOVE    PEG
        ASSIGN  TRIES 3
        STOP    [0 0 -20]
DOWN:   CHANGE  [0 0 -1] .5
        SKIPE   23
        JUMP    HIT
        SOJG    TRIES DOWN
        WAIT    "NOTHING UNDER THE HAND"
HIT:    CHANGE  [0 0 1] 2
        PARK
