; press the plug in and check how deep it went
        TRANS   PLUG [18 44 3 90 90 0]
        TRANS   PORT [25 38 4 90 90 0]
        OPEN    1.5
        MOVE    PLUG
        CLOSE   .5
        MOVE    PORT
        STOP    [0 0 -40]
        FREE    [1 1 0]         ;let the port guide it
        CHANGE  [0 0 -1] .6
        TRAVEL  .7 .9
        SKIPN   8
        WAIT    "the plug stands too high or too low"
        OPEN    1.5
        CHANGE  Z 2
