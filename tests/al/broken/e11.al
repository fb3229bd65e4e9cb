; put the first pin back, with a look at how far it went
        OPEN    .6
        MOVE    Q1
        CLOSE   .1
        CHANGE  [0 0 1] 2
        MOVE    P1_UP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 1.2
        TRAVEL  .7 1.1
        SKIPN   8
        WAIT    "it stands on the holder"
        OPEN    1
        PARK
